#include <fmt/format.h>

#include <cmath>

#include "framework/shapes/length_unit.hpp"
#include "framework/meshing/mesh_operation.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

class Scale : public MeshOperation {
 public:
  Mesh apply(const Mesh& mesh, const std::string& name, Notes& notes) const override {
    Mesh result = mesh;
    const double factor = factor_of(bounding_box(mesh), name);
    scale(result, Vec3::Constant(factor));
    notes.push_back(scaled_note(result, factor));
    return result;
  }

 protected:
  void parameters(Fields& f) override {
    f.optional_number("factor", factor_, units::none, "scale factor about the origin").positive();
    f.optional_number("size", size_, units::length, "instead of factor: the longest edge of the bounding box").positive();
    f.text("from", units_.from, "instead of factor: unit of the coordinates: mm, inch, ...");
    f.text("to", units_.to, "unit of the result; tack reads metres");
    f.check("from", [this] { return units_.problem(); });
    f.check("factor", [this]() -> std::string {
      const int given = (factor_ ? 1 : 0) + (size_ ? 1 : 0) + (units_.trivial() ? 0 : 1);
      return given == 1 ? "" : "by how much? Give one of factor, size and from (with to), as in from=mm";
    });
  }

 private:
  double factor_of(const Eigen::AlignedBox3d& box, const std::string& name) const {
    if (factor_) return *factor_;
    if (!size_) return units_.factor();
    const double size = box.sizes().maxCoeff();
    if (!(size > 0)) throw InputError(name + ": has no size that could be made another; give a factor");
    return *size_ / size;
  }

  std::optional<double> factor_, size_;  // 1, m
  LengthUnits units_;
};
TACK_REGISTER(MeshOperation, Scale, "scale", "A mesh scaled by a factor, to a size, or from one unit to another.", "");

}  // namespace
}  // namespace tack
