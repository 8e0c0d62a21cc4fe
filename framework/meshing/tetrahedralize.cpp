#include "geometry/meshing/tetrahedralize.hpp"

#include "framework/meshing/mesh_operation.hpp"

namespace tack {
namespace {

class Tetrahedralize : public MeshOperation {
 public:
  Mesh apply(const Mesh& mesh, const std::string& name, Notes& notes) const override { return tetrahedralize(mesh, options_, name, notes); }

 protected:
  void parameters(Fields& f) override {
    f.number("edge_length", options_.edge_length, units::length, "approximate edge length of tets").required().positive();
    f.optional_number("surface_edge_length", options_.surface_edge_length, units::length,
                      "edge length of their faces on the surface; edge_length unless given").positive();
    f.optional_number("deviation", options_.deviation, units::length,
                      "largest deviation of the surface in either direction; a tenth of its edge length unless given").positive();
    f.number("radius_edge", options_.radius_edge, units::none, "largest ratio of circumradius to shortest edge of a tet, before slivers are treated")
        .at_least(2);
    f.number("dihedral_angle", options_.dihedral_angle, units::angle, "smallest dihedral angle of tets, 8 degrees unless given; a warning reports "
                                                                      "smaller ones")
        .range(0, 0.35);
    f.number("crease_angle", options_.crease_angle, units::angle, "angle between neighbouring normals above which an edge is a feature, which is kept")
        .positive();
  }

 private:
  TetrahedralizeOptions options_;
};
TACK_REGISTER(MeshOperation, Tetrahedralize, "tetrahedralize", "A closed surface filled with tets.",
              "Jamin et al., CGALmesh: a generic framework for Delaunay mesh generation, 2015");

}  // namespace
}  // namespace tack
