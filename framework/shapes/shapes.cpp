// The built-in shapes and mesh files, as components of the scene file.
#include <fmt/format.h>

#include <mutex>
#include <numbers>

#include "framework/config/field.hpp"
#include "framework/shapes/length_unit.hpp"
#include "framework/shapes/shape_source.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/mesh_io.hpp"
#include "geometry/mesh/cleanup.hpp"
#include "geometry/shapes/lines.hpp"
#include "geometry/shapes/rounded_box.hpp"
#include "geometry/shapes/sector.hpp"
#include "geometry/shapes/solids.hpp"
#include "geometry/shapes/surfaces.hpp"

namespace tack {
namespace {

class BoxShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.vector("size", size_, units::length, "edge lengths; centred at the origin").required().positive();
    f.vector("cells", cells_, "cells along each edge, six tets each").at_least(1);
    f.number("rounding", rounding_, units::length, "radius of its edges and corners; cells are not longer").at_least(0);
    f.flag("surface", surface_, "triangles of the boundary only, no tets");
  }
  Mesh make() const override {
    Mesh mesh = surface_ ? box_surface(size_, cells_) : box_tets(size_, cells_);
    round_box(mesh, size_, cells_, rounding_);
    return mesh;
  }

 private:
  Vec3 size_ = Vec3::Ones();  // m
  std::array<int, 3> cells_ = {1, 1, 1};
  double rounding_ = 0;  // m
  bool surface_ = false;
};

class SphereShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.number("radius", radius_, units::length, "radius; centred at the origin").required().positive();
    f.integer("cells", cells_, "cells across the diameter").at_least(2);
    f.flag("surface", surface_, "triangles of the boundary only, no tets");
  }
  Mesh make() const override { return surface_ ? sphere_surface(radius_, cells_) : sphere(radius_, cells_); }

 private:
  double radius_ = 1;  // m
  int cells_ = 8;
  bool surface_ = false;
};

class CylinderShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.number("radius", radius_, units::length, "radius").required().positive();
    f.number("height", height_, units::length, "extent along y; centred at the origin")
        .required().positive();
    f.integer("cells_across", across_, "cells across the diameter").at_least(2);
    f.integer("cells_along", along_, "cells along the height").at_least(1);
  }
  Mesh make() const override { return cylinder(radius_, height_, across_, along_); }

 private:
  double radius_ = 1, height_ = 1;  // m
  int across_ = 8, along_ = 8;
};

class SectorShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.number("angle", shape_.angle, units::angle, "angle of the sector; small, because it is one cell wide").positive();
    f.vectors("rings", rings_, units::length, "cells along the radius: positions from 0 to the rim, each with the cell length there; linear in "
                                              "between").required();
    f.vectors("layers", layers_, units::length, "cells along the depth: positions, each with the cell length there; linear in between").required();
    f.number("crown", shape_.crown, units::length, "radius of the spherical top; 0: flat").nonnegative();
  }
  Mesh make() const override {
    Sector shape = shape_;
    shape.radii = graded(rings_);
    shape.depths = graded(layers_);
    return sector(shape);
  }

 private:
  Sector shape_{.angle = std::numbers::pi / 18, .crown = 0, .radii = {}, .depths = {}};
  std::vector<Vec2> rings_, layers_;  // m
};

class VoussoirShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.number("inner_radius", stone_.inner_radius, units::length, "radius of the arch below").positive();
    f.number("outer_radius", stone_.outer_radius, units::length, "radius of the arch above").positive();
    f.number("angle", stone_.angle, units::angle, "angle of the arch that it spans, joint included").positive();
    f.number("depth", stone_.depth, units::length, "extent along z").positive();
    f.number("joint", stone_.joint, units::length, "gap to the next stone, half of it on each side").nonnegative();
    f.vector("cells", cells_, "cells along the arc, the radius and z").at_least(1);
  }
  Mesh make() const override { return voussoir(stone_, cells_); }

 private:
  Voussoir stone_;
  std::array<int, 3> cells_ = {1, 1, 1};
};

class GridShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.vector("size", size_, units::length, "extent along x and z; in the plane y = 0").required().positive();
    f.vector("cells", cells_, "cells along x and z, two triangles each").at_least(1);
    f.choice("diagonals", diagonals_,
             {{"alternating", Diagonals::alternating, "neighbouring cells are cut along different diagonals"},
              {"uniform", Diagonals::uniform, "all cells are cut along the same diagonal"}},
             "diagonals of the cells");
    f.number("jitter", jitter_, units::none,
             "random displacement of interior vertices in the plane, as a fraction of a cell; borders stay")
        .range(0, 0.24);
    f.integer("seed", seed_, "random seed of the jitter").at_least(0);
  }
  Mesh make() const override { return grid(size_, cells_, diagonals_, jitter_, seed_); }

 private:
  Vec2 size_ = Vec2::Ones();  // m
  std::array<int, 2> cells_ = {1, 1};
  Diagonals diagonals_ = Diagonals::alternating;
  double jitter_ = 0;
  int seed_ = 1;
};

class SegmentShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.number("length", length_, units::length, "extent along x; centred at the origin").required().positive();
    f.integer("edges", edges_, "edges").at_least(1);
  }
  Mesh make() const override { return segment(length_, edges_); }

 private:
  double length_ = 1;  // m
  int edges_ = 1;
};

class RingShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.number("radius", radius_, units::length, "radius of its vertices, in the plane y = 0; centred at the origin").required().positive();
    f.integer("edges", edges_, "edges").at_least(3);
  }
  Mesh make() const override { return ring(radius_, edges_); }

 private:
  double radius_ = 1;  // m
  int edges_ = 32;
};

class HelixShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.number("radius", radius_, units::length, "radius about the y axis; right-handed, centred at the origin").required().positive();
    f.number("pitch", pitch_, units::length, "rise along y in a turn").required().positive();
    f.number("turns", turns_, units::none, "number of turns").positive();
    f.integer("edges", edges_, "edges").at_least(1);
  }
  Mesh make() const override { return helix(radius_, pitch_, turns_, edges_); }

 private:
  double radius_ = 1, pitch_ = 1, turns_ = 1;  // m, m, 1
  int edges_ = 32;
};

class NetShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.vector("size", size_, units::length, "extent along x and z; in the plane y = 0").required().positive();
    f.vector("cells", cells_, "meshes along x and z; groups of vertices: knots, border").at_least(1);
    f.integer("edges", edges_, "edges of each side of a mesh").at_least(1);
  }
  Mesh make() const override { return net(size_, cells_, edges_); }

 private:
  Vec2 size_ = Vec2::Ones();  // m
  std::array<int, 2> cells_ = {4, 4};
  int edges_ = 2;
};

class WebShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.number("radius", radius_, units::length, "length of the spokes, in the plane y = 0; groups of vertices: centre, ends, spiral").required().positive();
    f.number("inner_radius", inner_radius_, units::length, "radius at which the spiral begins").required().positive();
    f.number("edge_length", edge_length_, units::length, "straight pieces are divided into edges no longer than this").required().positive();
    f.integer("spokes", spokes_, "spokes").at_least(3);
    f.integer("turns", turns_, "turns of the spiral").at_least(1);
  }
  Mesh make() const override { return web(radius_, inner_radius_, spokes_, turns_, edge_length_); }

 private:
  double radius_ = 1, inner_radius_ = 0.2, edge_length_ = 0.1;  // m
  int spokes_ = 12, turns_ = 6;
};

class PointsShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.vector("size", size_, units::length, "extent of a grid of points; centred at the origin").nonnegative();
    f.vector("counts", counts_, "points along each axis; one alone is in the middle").at_least(1);
  }
  Mesh make() const override { return point_grid(size_, counts_); }

 private:
  Vec3 size_ = Vec3::Zero();  // m
  std::array<int, 3> counts_ = {1, 1, 1};
};

class FileShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.path("path", path_, "obj, ply, stl, off, glb, gltf, msh, vtk or vtu; relative to the scene file").required();
    f.text("unit", unit_, "unit of the numbers in the file: m, mm, um, inch").line();
    f.optional_number("weld", weld_, units::length, "vertices at most this far apart become the first of them; elements that collapse are dropped. Unless given, vertices stay as they "
                                                    "are").nonnegative();
    f.check("unit", [this] { return LengthUnits{unit_, "m"}.problem(); });
  }
  Mesh make() const override {
    Mesh mesh = read_mesh(path_);
    std::vector<std::string> notes;
    if (const LengthUnits units{unit_, "m"}; !units.trivial()) {
      scale(mesh, Vec3::Constant(units.factor()));
      notes.push_back(scaled_note(mesh, units.factor()));
    }
    if (weld_) notes.push_back(welded(mesh));
    const std::lock_guard lock(notes_mutex_);
    notes_ = std::move(notes);
    return mesh;
  }
  bool reads_files() const override { return true; }
  std::vector<std::string> notes() const override {
    const std::lock_guard lock(notes_mutex_);
    return notes_;
  }

 private:
  // Returns the note of the vertices that were merged.
  std::string welded(Mesh& mesh) const {
    const auto elements = [&] { return mesh.tets.size() + mesh.triangles.size() + mesh.edges.size() + mesh.points.size(); };
    const size_t vertices_before = mesh.vertices.size(), elements_before = elements();
    merge_duplicate_vertices(mesh, *weld_);
    if (elements() == 0) throw InputError(fmt::format("{}: all elements collapse when vertices within {:.6g} m are welded; weld shorter distances, and state the unit of the file", path_, *weld_));
    return fmt::format("welded: {} of {} vertices merged with others within {:.3g} m, {} elements dropped", vertices_before - mesh.vertices.size(), vertices_before, *weld_,
                       elements_before - elements());
  }

  std::string path_;
  std::string unit_ = "m";
  std::optional<double> weld_;  // m
  mutable std::mutex notes_mutex_;
  mutable std::vector<std::string> notes_;  // of the last mesh
};

TACK_REGISTER(ShapeSource, BoxShape, "box", "A box of tets (or its surface).", "");
TACK_REGISTER(ShapeSource, SphereShape, "sphere", "A ball of tets (or its surface).", "");
TACK_REGISTER(ShapeSource, CylinderShape, "cylinder", "A cylinder of tets along y.", "");
TACK_REGISTER(ShapeSource, SectorShape, "sector",
              "A thin sector of a body of revolution about y, one cell wide, with graded cells, for axisymmetric "
              "problems. Its sides are symmetry planes: fix them with `along` their normals. Groups: axis, left, "
              "right, top, bottom, rim.", "");
TACK_REGISTER(ShapeSource, VoussoirShape, "voussoir",
              "A stone of an arch about the z axis, at the crown; rotate it into position.", "");
TACK_REGISTER(ShapeSource, GridShape, "grid", "A flat sheet of triangles.", "");
TACK_REGISTER(ShapeSource, SegmentShape, "segment", "A straight line of edges along x.", "");
TACK_REGISTER(ShapeSource, RingShape, "ring", "A closed polygon of edges.", "");
TACK_REGISTER(ShapeSource, HelixShape, "helix", "A helix of edges along y.", "");
TACK_REGISTER(ShapeSource, NetShape, "net", "Threads of edges that cross at right angles.", "");
TACK_REGISTER(ShapeSource, WebShape, "web", "A spider's web of edges: spokes and a spiral.", "");
TACK_REGISTER(ShapeSource, PointsShape, "points", "Points of a grid, or one.", "");
TACK_REGISTER(ShapeSource, FileShape, "file", "A mesh read from a file.", "");

}  // namespace
}  // namespace tack
