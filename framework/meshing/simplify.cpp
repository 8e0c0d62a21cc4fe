#include "geometry/meshing/simplify.hpp"

#include "framework/meshing/mesh_operation.hpp"

namespace tack {
namespace {

class Simplify : public MeshOperation {
 public:
  Mesh apply(const Mesh& mesh, const std::string& name, Notes& notes) const override { return simplify(mesh, triangles_, name, notes); }

 protected:
  void parameters(Fields& f) override { f.integer("triangles", triangles_, "number of triangles of the result").required().at_least(4); }

 private:
  int triangles_ = 4;
};
TACK_REGISTER(MeshOperation, Simplify, "simplify", "A surface of fewer triangles.",
              "Lindstrom and Turk, Fast and memory efficient polygonal simplification, 1998");

}  // namespace
}  // namespace tack
