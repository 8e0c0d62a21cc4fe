// Fluid cavity whose content stores energy: a gas or a liquid. A step from V, t to V', t', with an
// amount m that becomes m' when the step is accepted, has the energy flows
//     work_filling      W(V', m, t') - W(V, m, t) plus the work on the surface, the integral of p
//                       dV by Simpson's rule
//     dissipated_leak   W(V', m, t') - W(V', m', t')
#pragma once

#include <functional>

#include "framework/load/cavity_content.hpp"

namespace tack {

class FluidCavityTerm : public VolumeTerm {
 public:
  FluidCavityTerm(std::string label, OrientedSurface surface, const VecX& rest,
                  const StoredContent& content);

  // Sets the leak rate at x in addition to that of the content [1/s].
  void set_leak(std::function<double(const VecX& x)> rate) { leak_ = std::move(rate); }

  bool stores() const override { return true; }
  // The residual form is left out: content is stiff, and a model with a constant force would not
  // converge.
  const ResidualView* residual_view() const override { return nullptr; }
  void publish(Records& records) const override;
  void load_history(const History& history) override;
  void commit(const VecX& x, History& history) const override;

  std::vector<double> abrupt_times() const override { return content_.corners(); }
  double pressure(const VecX& x, double time) const override {
    return content_.at(volume(x), volume_at_rest_, amount_, time).pressure;
  }
  double target(double time) const override { return content_.target(volume_at_rest_, time); }
  double amount() const override;

 protected:
  VolumeSample sample(double volume, double fraction) const override;

 private:
  // Returns the time of the stored state [s].
  double stored_time() const { return has_history_ ? stored_time_ : time(); }
  double energy(double volume, double amount, double at) const {
    return content_.at(volume, volume_at_rest_, amount, at).energy;
  }
  double amount_after(const VecX& x) const;
  void flows(const VecX& x, double* amounts) const;

  const StoredContent& content_;
  double volume_at_rest_;  // m^3
  double amount_ = 1;
  double stored_time_ = 0;  // s
  bool has_history_ = false;
  std::function<double(const VecX&)> leak_;
};

}  // namespace tack
