#include "geometry/meshing/booleans.hpp"

#include "framework/meshing/mesh_operation.hpp"
#include "framework/shapes/mesh_cache.hpp"
#include "framework/shapes/mesh_placement.hpp"
#include "framework/shapes/shape_source.hpp"

namespace tack {
namespace {

template <Boolean kind>
class BooleanOperation : public MeshOperation {
 public:
  void prepare() override {
    other_ = mesh_of_shape(*with_)->mesh;
    placement_.apply(other_);
  }
  Mesh apply(const Mesh& mesh, const std::string& name, Notes& notes) const override {
    return boolean(kind, mesh, other_, name, name + ", `with`", notes);
  }

 protected:
  void parameters(Fields& f) override {
    f.component("with", with_, "the other solid").required();
    f.object("place", placement_, "its placement");
  }

 private:
  std::unique_ptr<ShapeSource> with_;
  MeshPlacement placement_;
  Mesh other_;
};

using Union = BooleanOperation<Boolean::unite>;
using Difference = BooleanOperation<Boolean::subtract>;
using Intersection = BooleanOperation<Boolean::intersect>;
TACK_REGISTER(MeshOperation, Union, "union", "The union of two solids.", "");
TACK_REGISTER(MeshOperation, Difference, "difference", "A solid minus another.", "");
TACK_REGISTER(MeshOperation, Intersection, "intersection", "The common part of two solids.", "");

}  // namespace
}  // namespace tack
