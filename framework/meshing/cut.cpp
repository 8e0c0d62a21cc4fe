#include "framework/meshing/mesh_operation.hpp"
#include "geometry/meshing/booleans.hpp"

namespace tack {
namespace {

class Cut : public MeshOperation {
 public:
  Mesh apply(const Mesh& mesh, const std::string& name, Notes& notes) const override { return cut(mesh, point_, normal_, name, notes); }

 protected:
  void parameters(Fields& f) override {
    f.vector("point", point_, units::length, "on the plane");
    f.vector("normal", normal_, units::none, "of the plane: what lies on its side is taken away").required();
  }

 private:
  Vec3 point_ = Vec3::Zero();  // m
  Vec3 normal_ = Vec3::UnitY();
};
TACK_REGISTER(MeshOperation, Cut, "cut", "What a plane leaves of a solid, closed by the cut.", "");

}  // namespace
}  // namespace tack
