// TR-BDF2 (Bank et al. 1985; Hosea and Shampine 1996): the trapezoidal rule up to g h, then backward
// differences of second order over the start, that point and the end. Second order and L-stable
// with g = 2 - sqrt 2, for which both stages have the same diagonal d = g / 2. As a Runge-Kutta
// method:
//     v_1 = v + h (d b_0 + d b_1),   v_2 = v + h (w b_0 + w b_1 + d b_2),   w = sqrt 2 / 4,
// and the same for x. The embedded weights are of third order (Hosea and Shampine, table 1).
#include <cmath>

#include "framework/stepping/integrators/runge_kutta.hpp"

namespace tack {
namespace {

class TrBdf2 : public RungeKutta {
 public:
  TrBdf2() : RungeKutta({g, 1}, {{d, d}, {w, w, d}}, {(1 - w) / 3, (3 * w + 1) / 3, d / 3}) {}

 private:
  static inline const double g = 2 - std::sqrt(2.0), d = g / 2, w = std::sqrt(2.0) / 4;
};

TACK_REGISTER(TimeIntegrator, TrBdf2, "tr_bdf2",
              "Second order, two stages, L-stable, with the smallest error of the L-stable ones; contact as an implicit impulse.",
              "Bank, Coughran, Fichtner, Grosse, Rose, Smith 1985; Hosea and Shampine 1996, Analysis and implementation of TR-BDF2");

}  // namespace
}  // namespace tack
