#include "geometry/meshing/tetrahedralize.hpp"

#include "framework/meshing/mesh_operation.hpp"

namespace tack {
namespace {

class Tetrahedralize : public MeshOperation {
 public:
  Mesh apply(const Mesh& mesh, const std::string& name, Notes& notes) const override { return tetrahedralize(mesh, options_, name, notes); }

 protected:
  void parameters(Fields& f) override {
    f.number("edge_length", options_.edge_length, units::length, "of tets, about").required().positive();
    f.optional_number("surface_edge_length", options_.surface_edge_length, units::length,
                      "of their faces on the surface: edge_length unless given").positive();
    f.optional_number("deviation", options_.deviation, units::length,
                      "of the surface, both ways, at most: a tenth of its edge length unless given").positive();
    f.number("radius_edge", options_.radius_edge, units::none, "circumradius to shortest edge of a tet, at most, before slivers are treated")
        .at_least(2);
    f.number("dihedral_angle", options_.dihedral_angle, units::angle, "of tets, at least: 8 degrees; there is a warning where it is not reached")
        .range(0, 0.35);
    f.number("crease_angle", options_.crease_angle, units::angle, "normals of neighbours that differ by more make an edge, which is kept")
        .positive();
  }

 private:
  TetrahedralizeOptions options_;
};
TACK_REGISTER(MeshOperation, Tetrahedralize, "tetrahedralize", "A solid of tets inside a closed surface.",
              "Jamin et al., CGALmesh: a generic framework for Delaunay mesh generation, 2015");

}  // namespace
}  // namespace tack
