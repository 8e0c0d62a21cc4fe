// Signed root of the energy of a normal law above its lowest value, for least squares:
//     rho(d) = sign(d - d*) sqrt(2 (phi(d) - phi(d*))),    rho' = phi' / rho,
// with d* the gap of lowest energy: the bottom of the well, or the range of a law that only repels.
// rho is smooth and increases through d*, and rho rho' = phi'.
#pragma once

#include "framework/contact/laws/pair_law.hpp"

namespace tack {

class LawRoot {
 public:
  explicit LawRoot(const PairLaw& law);

  double depth() const { return depth_; }  // -phi(d*) [J/m^2]

  struct Sample {
    double value = 0, slope = 0;  // rho [J^1/2 / m], rho' [J^1/2 / m^2]
  };
  Sample at(double d, const LawSample& phi) const;

 private:
  double gap_;     // d* [m]
  double offset_;  // of the law [m]
  double depth_ = 0;
  double stiffness_ = 0;  // phi''(d*)^1/2; 0 for a law that only repels
};

}  // namespace tack
