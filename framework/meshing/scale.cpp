#include <fmt/format.h>

#include "framework/meshing/mesh_operation.hpp"

namespace tack {
namespace {

class Scale : public MeshOperation {
 public:
  Mesh apply(const Mesh& mesh, const std::string&, Notes& notes) const override {
    Mesh result = mesh;
    scale(result, Vec3::Constant(factor_));
    const Vec3 size = bounding_box(result).sizes();
    notes.push_back(fmt::format("scaled by {:.6g}: now {:.4g} x {:.4g} x {:.4g} m", factor_, size.x(), size.y(), size.z()));
    return result;
  }

 protected:
  void parameters(Fields& f) override {
    f.number("factor", factor_, units::none, "of all lengths, about the origin: 0.001 for a file in millimetres").required().positive();
  }

 private:
  double factor_ = 1;
};
TACK_REGISTER(MeshOperation, Scale, "scale", "The same mesh in another size: for files that are not in metres.", "");

}  // namespace
}  // namespace tack
