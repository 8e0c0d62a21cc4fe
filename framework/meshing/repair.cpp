#include "geometry/meshing/repair.hpp"

#include "framework/meshing/mesh_operation.hpp"

namespace tack {
namespace {

class Repair : public MeshOperation {
 public:
  Mesh apply(const Mesh& mesh, const std::string& name, Notes& notes) const override { return repair(mesh, options_, name, notes); }

 protected:
  void parameters(Fields& f) override {
    f.number("merge", options_.merge, units::length, "vertices that close become one").nonnegative();
    f.flag("fill_holes", options_.fill_holes, "otherwise open edges stay");
  }

 private:
  RepairOptions options_;
};
TACK_REGISTER(MeshOperation, Repair, "repair",
              "A broken surface made closed and manifold, with normals outwards, or refused with the numbers of what is broken.", "");

}  // namespace
}  // namespace tack
