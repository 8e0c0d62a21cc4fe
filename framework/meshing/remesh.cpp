#include "geometry/meshing/remesh.hpp"

#include "framework/meshing/mesh_operation.hpp"

namespace tack {
namespace {

class Remesh : public MeshOperation {
 public:
  Mesh apply(const Mesh& mesh, const std::string& name, Notes& notes) const override { return remesh(mesh, options_, name, notes); }

 protected:
  void parameters(Fields& f) override {
    f.number("edge_length", options_.edge_length, units::length, "target edge length; most edges are between 4/5 and 4/3 of it").required().positive();
    f.number("crease_angle", options_.crease_angle, units::angle, "angle between neighbouring normals above which an edge is a crease, which is kept")
        .positive();
    f.integer("iterations", options_.iterations, "iterations of splits, collapses, flips and smoothing").at_least(1);
  }

 private:
  RemeshOptions options_;
};
TACK_REGISTER(MeshOperation, Remesh, "remesh", "A surface with edges of one length; borders and creases stay.",
              "Botsch and Kobbelt, A remeshing approach to multiresolution modeling, 2004");

}  // namespace
}  // namespace tack
