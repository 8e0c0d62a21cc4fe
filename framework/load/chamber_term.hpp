// Chamber with a filling that stores energy: a gas, a liquid. A step from V, t to V', t', with an
// amount m that becomes m' when the step is accepted, has the energy flows
//     work_filling      W(V', m, t') - W(V, m, t) plus the work on the surface, the integral of p
//                       dV by Simpson's rule
//     dissipated_leak   W(V', m, t') - W(V', m', t')
#pragma once

#include <functional>

#include "framework/load/filling.hpp"

namespace tack {

class ChamberTerm : public VolumeTerm {
 public:
  ChamberTerm(std::string label, OrientedSurface surface, const VecX& rest,
              const StoredFilling& filling);

  // Returns the leak rate at x beside that of the filling [1/s].
  void set_vent(std::function<double(const VecX& x)> rate) { vent_ = std::move(rate); }

  bool stores() const override { return true; }
  // It is stiff: what holds its force at a point would go nowhere.
  const ResidualView* residual_view() const override { return nullptr; }
  void publish(Records& records) const override;
  void load_history(const History& history) override;
  void commit(const VecX& x, History& history) const override;

  std::vector<double> abrupt_times() const override { return filling_.corners(); }
  double pressure(const VecX& x, double time) const override {
    return filling_.at(volume(x), at_rest_, amount_, time).pressure;
  }
  double target(double time) const override { return filling_.target(at_rest_, time); }
  double amount() const override;

 protected:
  VolumeSample sample(double volume, double part) const override;

 private:
  // Returns the time of the stored state [s]
  double kept_time() const {
    return remembers_ ? kept_ : time();
  }
  double energy(double volume, double amount, double at) const {
    return filling_.at(volume, at_rest_, amount, at).energy;
  }
  double amount_after(const VecX& x) const;
  void flows(const VecX& x, double* amounts) const;

  const StoredFilling& filling_;
  double at_rest_;      // m^3
  double amount_ = 1;
  double kept_ = 0;     // s
  bool remembers_ = false;
  std::function<double(const VecX&)> vent_;
};

}  // namespace tack
