#include "energies/solid/principal.hpp"

#include <Eigen/LU>

#include "framework/assembly/psd_projection.hpp"

namespace tack {

void project_diagonal(PackMat3& a, Projection projection) {
  if (projection == Projection::none) return;
  const Pack minor = a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0);
  const PackMask definite = (a(0, 0) > 0) & (minor > 0) & (a.determinant() > 0);
  if (!any(~definite)) return;
  for (int l = 0; l < pack_width; ++l) {
    if (definite[l]) continue;
    Mat3 lane = get_lane<3, 3>(a, l);
    project_psd<3>(lane, projection);
    set_lane<3, 3>(a, l, lane);
  }
}

}  // namespace tack
