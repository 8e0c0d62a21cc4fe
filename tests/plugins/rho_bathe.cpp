// Composite method of two stages (Noh and Bathe 2019): a trapezoidal rule up to gamma h, then weights of all three nodes. rho
// (rho_inf) is the factor by which an infinitely fast vibration shrinks in a step; 0 is TR-BDF2, 1 two trapezoidal rules. With
//     gamma = (2 - sqrt(2 + 2 rho)) / (1 - rho),   q_1 = (rho + 1) / (2 gamma (rho - 1) + 4),
//     q_0 = (gamma - 1) q_1 + 1/2,                 q_2 = -gamma q_1 + 1/2 = gamma / 2.
#include <cmath>

#include "framework/config/field.hpp"
#include "framework/stepping/integrators/runge_kutta.hpp"

namespace composite {

class RhoBathe : public tack::RungeKutta {
 public:
  RhoBathe() : RungeKutta({1}, {{0, 1}}) { set(); }
  void fields(tack::Fields& f) override {
    f.number("rho_inf", rho_, tack::units::none, "factor of the amplitude of an infinitely fast vibration in a step").range(0, 0.999);
    f.check("rho_inf", [this]() -> std::string { return set(), ""; });
  }

 private:
  void set() {
    const double g = (2 - std::sqrt(2 + 2 * rho_)) / (1 - rho_), q1 = (rho_ + 1) / (2 * g * (rho_ - 1) + 4);
    set_tableau({g, 1}, {{g / 2, g / 2}, {(g - 1) * q1 + 0.5, q1, 0.5 - g * q1}});
  }

  double rho_ = 0.5;
};

using tack::TimeIntegrator;
TACK_REGISTER(TimeIntegrator, RhoBathe, "rho_bathe", "Second order, two stages, with a chosen damping of fast vibrations.",
              "Noh and Bathe 2019, The Bathe time integration method with controllable spectral radius");
}  // namespace composite
