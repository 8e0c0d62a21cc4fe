// Shape composed of other shapes.
#include "framework/shapes/mesh_cache.hpp"
#include "framework/shapes/mesh_placement.hpp"
#include "framework/shapes/shape_source.hpp"

namespace tack {
namespace {

struct PartConfig {
  std::unique_ptr<ShapeSource> shape;
  MeshPlacement placement;
  void fields(Fields& f) {
    f.component("shape", shape, "mesh of the part").required();
    f.object("place", placement, "scale, rotate, translate it");
  }
};

class PartsShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.list("parts", parts_, "component shapes; coincident vertices are not merged, groups of the same name are united").required().nonempty();
  }
  bool costly() const override {
    return std::any_of(parts_.begin(), parts_.end(), [](const PartConfig& part) { return part.shape->costly(); });
  }
  Mesh make() const override {
    Mesh all;
    for (const PartConfig& part : parts_) {
      Mesh mesh = mesh_of_shape(*part.shape)->mesh;
      part.placement.apply(mesh);
      append(all, mesh);
    }
    return all;
  }
  bool reads_files() const override {
    return std::any_of(parts_.begin(), parts_.end(), [](const PartConfig& part) { return part.shape->reads_files(); });
  }

 private:
  std::vector<PartConfig> parts_;
};

TACK_REGISTER(ShapeSource, PartsShape, "parts", "Several shapes as one object, also of different dimensions.", "");

}  // namespace
}  // namespace tack
