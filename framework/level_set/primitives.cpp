// Primitive level sets.
#include <fmt/format.h>

#include "framework/config/field.hpp"
#include "framework/level_set/level_set.hpp"
#include "geometry/level_set/distance_formulas.hpp"
#include "geometry/level_set/polygon_distance.hpp"
#include "geometry/level_set/stroke_font.hpp"

namespace tack {
namespace {

Eigen::AlignedBox3d centred(const Vec3& half) { return {-half, half}; }

// Level set whose distance is a formula of the point.
class Primitive : public LevelSet {
 protected:
  void own_values(std::span<const Vec3> points, std::span<double> values) const final {
    for (size_t i = 0; i < points.size(); ++i) values[i] = distance(points[i]);
  }
  virtual double distance(const Vec3& p) const = 0;
};

class SphereLevelSet : public Primitive {
 public:
  void fields(Fields& f) override {
    f.number("radius", radius_, units::length, "about the origin").required().positive();
    LevelSet::fields(f);
  }

 protected:
  Eigen::AlignedBox3d own_bounds() const override { return centred(Vec3::Constant(radius_)); }
  double distance(const Vec3& p) const override { return sphere_distance(p, radius_); }

 private:
  double radius_ = 1;  // m
};

class BoxLevelSet : public Primitive {
 public:
  void fields(Fields& f) override {
    f.vector("size", size_, units::length, "edge lengths; centred at the origin").required().positive();
    f.number("rounding", rounding_, units::length, "radius of its edges and corners").nonnegative();
    f.check("rounding", [this]() -> std::string {
      return 2 * rounding_ <= size_.minCoeff() ? "" : fmt::format("at most half the shortest edge, {} m", size_.minCoeff() / 2);
    });
    LevelSet::fields(f);
  }

 protected:
  Eigen::AlignedBox3d own_bounds() const override { return centred(size_ / 2); }
  double distance(const Vec3& p) const override { return box_distance(p, (size_ / 2).array() - rounding_) - rounding_; }

 private:
  Vec3 size_ = Vec3::Ones();  // m
  double rounding_ = 0;       // m
};

class CapsuleLevelSet : public Primitive {
 public:
  void fields(Fields& f) override {
    f.vector("from", from_, units::length, "one end of its axis").required();
    f.vector("to", to_, units::length, "the other end").required();
    f.number("radius", radius_, units::length, "radius about the axis").required().positive();
    LevelSet::fields(f);
  }

 protected:
  Eigen::AlignedBox3d own_bounds() const override { return widened({from_.cwiseMin(to_), from_.cwiseMax(to_)}, radius_); }
  double distance(const Vec3& p) const override { return segment_distance(p, from_, to_) - radius_; }

 private:
  Vec3 from_ = Vec3::Zero(), to_ = Vec3::UnitY();  // m
  double radius_ = 1;                              // m
};

class TorusLevelSet : public Primitive {
 public:
  void fields(Fields& f) override {
    f.number("radius", radius_, units::length, "radius of the centre line of the tube, about the y axis").required().positive();
    f.number("tube", tube_, units::length, "radius of the tube").required().positive();
    LevelSet::fields(f);
  }

 protected:
  Eigen::AlignedBox3d own_bounds() const override { return centred({radius_ + tube_, tube_, radius_ + tube_}); }
  double distance(const Vec3& p) const override { return torus_distance(p, radius_, tube_); }

 private:
  double radius_ = 1, tube_ = 0.3;  // m
};

class ConeLevelSet : public Primitive {
 public:
  void fields(Fields& f) override {
    f.number("radius", bottom_, units::length, "radius at the bottom").required().nonnegative();
    f.number("top_radius", top_, units::length, "radius at the top").nonnegative();
    f.number("height", height_, units::length, "along y; centred at the origin").required().positive();
    f.check("radius", [this]() -> std::string { return bottom_ > 0 || top_ > 0 ? "" : "one of radius and top_radius must be positive"; });
    LevelSet::fields(f);
  }

 protected:
  Eigen::AlignedBox3d own_bounds() const override {
    const double radius = std::max(bottom_, top_);
    return centred({radius, height_ / 2, radius});
  }
  double distance(const Vec3& p) const override { return cone_distance(p, bottom_, top_, height_); }

 private:
  double bottom_ = 1, top_ = 0, height_ = 1;  // m
};

class CylinderLevelSet : public Primitive {
 public:
  void fields(Fields& f) override {
    f.number("radius", radius_, units::length, "about the y axis").required().positive();
    f.number("height", height_, units::length, "along y; centred at the origin").required().positive();
    LevelSet::fields(f);
  }

 protected:
  Eigen::AlignedBox3d own_bounds() const override { return centred({radius_, height_ / 2, radius_}); }
  double distance(const Vec3& p) const override {
    return extruded_distance(std::hypot(p.x(), p.z()) - radius_, p.y(), height_ / 2);
  }

 private:
  double radius_ = 1, height_ = 1;  // m
};

class PlaneLevelSet : public Primitive {
 public:
  void fields(Fields& f) override {
    f.vector("normal", normal_, units::none, "points outwards");
    f.number("offset", offset_, units::length, "distance of the plane from the origin, along the normal");
    f.check("normal", [this]() -> std::string { return normal_.norm() > 0 ? "" : "must not be zero"; });
    LevelSet::fields(f);
  }

 protected:
  Eigen::AlignedBox3d own_bounds() const override { return everywhere(); }
  double distance(const Vec3& p) const override { return p.dot(normal_.normalized()) - offset_; }

 private:
  Vec3 normal_ = Vec3::UnitY();
  double offset_ = 0;  // m
};

class ExtrudedLevelSet : public Primitive {
 public:
  void fields(Fields& f) override {
    f.vectors("polygon", corners_, units::length, "corners in order, x and y in the plane z = 0; the even-odd rule "
                                                  "holds if it crosses itself").required();
    f.number("depth", depth_, units::length, "extent along z, half of it on each side").required().positive();
    f.check("polygon", [this]() -> std::string { return corners_.size() >= 3 ? "" : "needs three corners or more"; });
    LevelSet::fields(f);
  }

 protected:
  Eigen::AlignedBox3d own_bounds() const override {
    Eigen::AlignedBox3d box;
    for (const Vec2& corner : corners_)
      for (const double z : {-depth_ / 2, depth_ / 2}) box.extend(Vec3(corner.x(), corner.y(), z));
    return box;
  }
  double distance(const Vec3& p) const override {
    return extruded_distance(polygon_distance(p.head<2>(), corners_), p.z(), depth_ / 2);
  }

 private:
  std::vector<Vec2> corners_;  // m
  double depth_ = 1;  // m
};

class TextLevelSet : public Primitive {
 public:
  void fields(Fields& f) override {
    f.text("text", text_, "capitals, digits and . , ! ? - + = / : ' & in a line along x").required();
    f.number("height", height_, units::length, "height of capitals, along y").required().positive();
    f.number("stroke", stroke_, units::length, "width of the strokes").required().positive();
    f.number("depth", depth_, units::length, "extent along z, half of it on each side").required().positive();
    f.check("text", [this] { return problem(); });
    LevelSet::fields(f);
  }
  void prepare(double) override {
    strokes_ = text_strokes(text_);
    for (Stroke& stroke : strokes_)
      for (Vec2& end : stroke) end *= height_;
  }

 protected:
  Eigen::AlignedBox3d own_bounds() const override {
    Eigen::AlignedBox3d box;
    for (const Stroke& stroke : strokes_)
      for (const Vec2& end : stroke) box.extend(Vec3(end.x(), end.y(), 0));
    if (box.isEmpty()) return box;
    const Vec3 around(stroke_ / 2, stroke_ / 2, depth_ / 2);
    return {box.min() - around, box.max() + around};
  }
  double distance(const Vec3& p) const override {
    double flat = std::numeric_limits<double>::infinity();
    for (const Stroke& stroke : strokes_) flat = std::min(flat, segment_distance(p.head<2>(), stroke[0], stroke[1]));
    return extruded_distance(flat - stroke_ / 2, p.z(), depth_ / 2);
  }

 private:
  std::string problem() const {
    try {
      return text_strokes(text_).empty() ? "has no letter in it" : "";
    } catch (const InputError& error) {
      return error.what();
    }
  }

  std::string text_;
  double height_ = 1, stroke_ = 0.1, depth_ = 0.1;  // m
  std::vector<Stroke> strokes_;
};

TACK_REGISTER(LevelSet, SphereLevelSet, "sphere", "A ball about the origin.", "");
TACK_REGISTER(LevelSet, BoxLevelSet, "box", "A box about the origin.", "");
TACK_REGISTER(LevelSet, CapsuleLevelSet, "capsule", "A capsule: all points within a radius of a segment.", "");
TACK_REGISTER(LevelSet, TorusLevelSet, "torus", "A ring about the y axis.", "");
TACK_REGISTER(LevelSet, CylinderLevelSet, "cylinder", "A cylinder along y.", "");
TACK_REGISTER(LevelSet, ConeLevelSet, "cone", "A cone or a frustum along y.", "");
TACK_REGISTER(LevelSet, PlaneLevelSet, "plane", "A half-space, to cut others with.", "");
TACK_REGISTER(LevelSet, ExtrudedLevelSet, "extruded", "A polygon, extruded along z.", "");
TACK_REGISTER(LevelSet, TextLevelSet, "text", "A line of text.", "");

}  // namespace
}  // namespace tack
