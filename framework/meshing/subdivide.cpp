#include "geometry/meshing/subdivide.hpp"

#include "framework/meshing/mesh_operation.hpp"

namespace tack {
namespace {

class Subdivide : public MeshOperation {
 public:
  Mesh apply(const Mesh& mesh, const std::string& name, Notes& notes) const override {
    return subdivide(mesh, rule_, times_, name, notes);
  }

 protected:
  void parameters(Fields& f) override {
    f.integer("times", times_, "number of subdivisions; each divides a triangle into four").range(1, 8);
    f.choice("rule", rule_,
             {{"loop", SubdivisionRule::loop, "smooths the surface"}, {"flat", SubdivisionRule::flat, "at the midpoints of edges: the surface is "
                                                                                                         "unchanged"}},
             "position of new vertices");
  }

 private:
  int times_ = 1;
  SubdivisionRule rule_ = SubdivisionRule::loop;
};
TACK_REGISTER(MeshOperation, Subdivide, "subdivide", "A surface of more triangles.",
              "Loop, Smooth subdivision surfaces based on triangles, 1987");

}  // namespace
}  // namespace tack
