// Sheets and solids swept by a profile: about an axis, or along a line.
#include <numbers>

#include "framework/shapes/profile.hpp"
#include "framework/shapes/shape_source.hpp"
#include "geometry/mesh/cleanup.hpp"
#include "geometry/mesh/triangle_surface.hpp"
#include "geometry/meshing/triangulate.hpp"
#include "geometry/shapes/swept.hpp"

namespace tack {
namespace {

class SweptShape : public ShapeSource {
 public:
  Mesh make() const final {
    const std::string name = "shape " + std::string(type());
    const std::vector<Vec2> points = profile_.points(name);
    if (!profile_.closed) return sheet(points);
    const Mesh tets = solid(triangulate(points, edge_length_.value_or(4.0 / 3 * longest_segment(points)), name));
    return surface_ ? triangle_surface(tets, name) : tets;
  }
  bool reads_files() const final { return profile_.closed; }  // the mesh depends on the version of CGAL

 protected:
  void profile_fields(Fields& f, const std::string& first) {
    profile_.fields(f, first);
    f.optional_number("edge_length", edge_length_, units::length,
                      "largest edge length of triangles in a closed profile; 4/3 of its longest cell unless given; longer sides are divided").positive();
    f.flag("surface", surface_, "for a closed profile: triangles of the boundary only, no tets");
    f.check("edge_length", [this] { return profile_.closed || !edge_length_ ? "" : "is for what is inside of a profile that is closed: true"; });
    f.check("surface", [this] { return profile_.closed || !surface_ ? "" : "a profile that is not closed makes a sheet, which is a surface anyway"; });
  }

 private:
  virtual Mesh sheet(const std::vector<Vec2>& profile) const = 0;
  virtual Mesh solid(const FlatMesh& section) const = 0;

  ProfileConfig profile_;
  std::optional<double> edge_length_;  // m
  bool surface_ = false;
};

class RevolvedShape : public SweptShape {
 public:
  void fields(Fields& f) override {
    profile_fields(f, "distance from the y axis, not negative");
    f.number("angle", angle_, units::angle, "angle of revolution about y, right-handed, from x; groups if it is less than a full turn: start, end").positive();
    f.check("angle", [this] { return angle_ <= whole * (1 + 1e-9) ? "" : "is more than a whole turn, 360 deg"; });
    f.integer("cells_around", cells_, "cells along the revolution, three or more for a full turn").at_least(1);
  }

 private:
  static constexpr double whole = 2 * std::numbers::pi;
  Mesh sheet(const std::vector<Vec2>& profile) const override { return revolved_sheet(profile, angle_, cells_); }
  Mesh solid(const FlatMesh& section) const override { return revolved_solid(section, angle_, cells_); }

  double angle_ = whole;  // rad
  int cells_ = 32;
};

class ExtrudedShape : public SweptShape {
 public:
  void fields(Fields& f) override {
    profile_fields(f, "position along x");
    f.number("length", length_, units::length, "extent along z, in the middle of which z is 0; groups at its ends: start, end").required().positive();
    f.integer("cells_along", cells_, "cells along the length").at_least(1);
  }

 private:
  Mesh sheet(const std::vector<Vec2>& profile) const override { return extruded_sheet(profile, length_, cells_); }
  Mesh solid(const FlatMesh& section) const override { return extruded_solid(section, length_, cells_); }

  double length_ = 1;  // m
  int cells_ = 8;
};

TACK_REGISTER(ShapeSource, RevolvedShape, "revolve", "A profile revolved about the y axis: a sheet, or a solid if the profile is closed.", "");
TACK_REGISTER(ShapeSource, ExtrudedShape, "extrude", "A profile extruded along z: a sheet, or a solid if the profile is closed.", "");

}  // namespace
}  // namespace tack
