// A shape with operations applied to it, one after the other.
#include <fmt/format.h>

#include <mutex>

#include "framework/meshing/mesh_operation.hpp"
#include "framework/shapes/mesh_cache.hpp"
#include "framework/shapes/mesh_placement.hpp"
#include "framework/shapes/shape_source.hpp"

namespace tack {
namespace {

class ProcessedShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.component("of", of_, "the shape to begin with").required();
    f.object("place", placement_, "placement before the first step");
    f.component_list("steps", steps_, "applied in that order").required().nonempty();
  }

  bool costly() const override { return true; }
  Mesh make() const override {
    std::call_once(once_, [this] { work(); });
    return mesh_;
  }
  Notes notes() const override {
    make();
    return notes_;
  }
  // The mesh also depends on the version of CGAL.
  bool reads_files() const override { return true; }

 private:
  void work() const {
    mesh_ = mesh_of_shape(*of_)->mesh;
    placement_.apply(mesh_);
    Notes notes;
    for (const auto& step : steps_) {
      notes.push_back(fmt::format("{}:", step->type()));
      Notes done;
      mesh_ = run_operation(*step, mesh_, fmt::format("shape '{}'", of_->type()), done);
      for (const std::string& line : done) notes.push_back("  " + line);
    }
    notes_ = notes;
  }

  std::unique_ptr<ShapeSource> of_;
  MeshPlacement placement_;
  std::vector<std::unique_ptr<MeshOperation>> steps_;
  mutable std::once_flag once_;
  mutable Mesh mesh_;
  mutable Notes notes_;
};
TACK_REGISTER(ShapeSource, ProcessedShape, "processed", "Another shape with operations applied to it: united, remeshed, filled with tets, ...", "");

}  // namespace
}  // namespace tack
