#include "framework/assembly/stencil_clamp.hpp"

#include <stdexcept>

#include "framework/assembly/psd_filter.hpp"
#include "framework/assembly/stencil_blocks.hpp"

namespace tack {
namespace {

template <int K>
void clamp_slots(double* slots) {
  Eigen::Matrix<double, 3 * K, 3 * K> hessian;
  load_blocks<K>(slots, hessian);
  project_stencil_psd<K>(hessian, SpdFilter::clamp);
  store_blocks<K>(hessian, slots);
}

}  // namespace

void clamp_stencil(int arity, double* slots) {
  switch (arity) {
    case 2: return clamp_slots<2>(slots);
    case 3: return clamp_slots<3>(slots);
    case 4: return clamp_slots<4>(slots);
    case 5: return clamp_slots<5>(slots);
    case 6: return clamp_slots<6>(slots);
  }
  throw std::logic_error("no stencil filter of this arity");
}

}  // namespace tack
