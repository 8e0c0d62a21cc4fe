// Singly diagonally implicit Runge-Kutta method of two stages (Alexander 1977): second order and
// L-stable with g = 1 - 1/sqrt 2. Stages end at g h and h. The first is implicit Euler's:
//     v_1 = v + g h b_1,   v_2 = v + (1 - g) h b_1 + g h b_2,   and the same for x.
// The method is not algebraically stable (that takes g >= 1/3): stresses of an impact in the first
// stage act with 1 / g - 1 = 2.4 times their impulse in the second. Its stages are of first order,
// which is what is left of the order where something stiff rotates.
#include <cmath>

#include "framework/stepping/integrators/runge_kutta.hpp"

namespace tack {
namespace {

class Sdirk2 : public RungeKutta {
 public:
  Sdirk2() : RungeKutta({g, 1}, {{0, g}, {0, 1 - g, g}}) {}

 private:
  static inline const double g = 1 - 1 / std::sqrt(2.0);
};

TACK_REGISTER(TimeIntegrator, Sdirk2, "sdirk2",
              "Second order, two stages, L-stable: damps fast vibrations at once, slow ones little; contact as an implicit impulse.",
              "Alexander 1977, Diagonally implicit Runge-Kutta methods for stiff O.D.E.'s");

}  // namespace
}  // namespace tack
