#include "geometry/shapes/rounded_box.hpp"

#include <fmt/format.h>

#include "geometry/errors.hpp"
#include "geometry/shapes/cube_to_ball.hpp"

namespace tack {

void round_box(Mesh& mesh, const Vec3& size, const std::array<int, 3>& cells, double rounding) {
  if (!(rounding >= 0 && 2 * rounding <= size.minCoeff()))
    throw InputError(fmt::format("box: rounding is {} m, but has to be from 0 to half of its shortest side, {} m", rounding,
                                 size.minCoeff() / 2));
  if (rounding == 0) return;
  for (int axis = 0; axis < 3; ++axis)
    if (const double cell = size[axis] / cells[static_cast<size_t>(axis)]; cell > rounding * (1 + 1e-9))
      throw InputError(fmt::format("box: along {} its cells are {} m long, longer than its rounding of {} m: use at least {}",
                                   "xyz"[axis], cell, rounding, std::ceil(size[axis] / rounding - 1e-9)));
  const Vec3 inner = size / 2 - Vec3::Constant(rounding);
  for (Vec3& x : mesh.vertices) {
    const Vec3 nearest = x.cwiseMax(-inner).cwiseMin(inner);
    x = nearest + rounding * cube_to_ball<3>((x - nearest) / rounding);
  }
}

}  // namespace tack
