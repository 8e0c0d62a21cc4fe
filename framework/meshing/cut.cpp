#include "framework/meshing/mesh_operation.hpp"
#include "geometry/meshing/booleans.hpp"

namespace tack {
namespace {

class Cut : public MeshOperation {
 public:
  Mesh apply(const Mesh& mesh, const std::string& name, Notes& notes) const override { return cut(mesh, point_, normal_, name, notes); }

 protected:
  void parameters(Fields& f) override {
    f.vector("point", point_, units::length, "a point of the plane");
    f.vector("normal", normal_, units::none, "normal of the plane; the side that it points to is removed").required();
  }

 private:
  Vec3 point_ = Vec3::Zero();  // m
  Vec3 normal_ = Vec3::UnitY();
};
TACK_REGISTER(MeshOperation, Cut, "cut", "A solid cut by a plane; the cut is closed.", "");

}  // namespace
}  // namespace tack
