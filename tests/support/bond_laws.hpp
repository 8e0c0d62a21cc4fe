// Laws of bonds for tests: every registered one, and one pulled by a script.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "framework/bond/bond_law.hpp"
#include "tests/support/component_variants.hpp"

namespace tack {

inline std::unique_ptr<BondLaw> bond_law(const std::string& yaml,
                                         const PairMaterials& pair = {.contact_distance = 1e-3}) {
  auto law = component<AdhesionLaw>(yaml);
  law->prepare(pair);
  return std::unique_ptr<BondLaw>(&dynamic_cast<BondLaw&>(*law.release()));
}

// One bond per area, and the work done on it.
class PulledBond {
 public:
  explicit PulledBond(const BondLaw& law, bool on_contact = false)
      : law_(law), history_(law.width()) {
    law.initialize(on_contact, history_.data());
  }

  // Steps to the opening d and the slip u; pressure: 0 for none.
  const BondSample& step(double d, double u, double h, double pressure = 0) {
    sample_ = law_.at(d, u * u, history_.data(), h);
    const double across = 2 * sample_.by_s * u;
    // Steps are those of implicit Euler, with the force of their end. The work is that of
    // the mean of the forces at both ends.
    work_ += (sample_.by_d + before_[0]) / 2 * (d - d_) + (across + before_[1]) / 2 * (u - u_);
    work_of_ends_ += sample_.by_d * (d - d_) + across * (u - u_);
    before_[0] = sample_.by_d, before_[1] = across, d_ = d, u_ = u;
    change_ = law_.advance(law_.assumed_state(d, u * u, h, pressure), history_.data());
    dissipated_ += change_.dissipated;
    return sample_;
  }
  // Steps to d and u in a number of steps of size h.
  void pull(double d, double u, int steps, double h) {
    const double from = d_, across = u_;
    for (int i = 1; i <= steps && !change_.gone; ++i) {
      step(from + (d - from) * i / steps, across + (u - across) * i / steps, h);
      peak_ = std::max(peak_, sample_.by_d);
      peak_across_ = std::max(peak_across_, 2 * sample_.by_s * u_);
    }
  }

  double traction() const { return sample_.by_d; }  // Pa
  double across() const { return before_[1]; }      // Pa
  double peak() const { return peak_; }             // of pull() [Pa]
  double peak_across() const { return peak_across_; }
  double work() const { return work_; }  // J/m^2
  // The force at the end of each step times its displacement.
  double work_of_ends() const { return work_of_ends_; }
  double dissipated() const { return dissipated_; }  // J/m^2
  double stored() const { return change_.gone ? 0 : law_.stored(d_, u_ * u_, history_.data()); }
  double intensity() const { return law_.intensity_of(history_.data()); }
  double* history() { return history_.data(); }
  const BondChange& change() const { return change_; }

 private:
  const BondLaw& law_;
  std::vector<double> history_;
  BondSample sample_;
  BondChange change_;
  double before_[2] = {0, 0}, d_ = 0, u_ = 0, work_ = 0, work_of_ends_ = 0, dissipated_ = 0,
         peak_ = 0, peak_across_ = 0;
};

}  // namespace tack
