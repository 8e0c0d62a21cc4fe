#include "energies/solid/principal.hpp"

#include "framework/assembly/psd_filter.hpp"

namespace tack {

void filter_diagonal(Mat3& a, SpdFilter filter) {
  if (filter == SpdFilter::none) return;
  const double minor = a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0);
  if (a(0, 0) > 0 && minor > 0 && a.determinant() > 0) return;
  project_psd<3>(a, filter);
}

}  // namespace tack
