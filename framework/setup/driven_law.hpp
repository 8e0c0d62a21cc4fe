// Adhesion whose factor follows a drive of a protocol: phi(d) u(t), u at the end of the step.
#pragma once

#include "framework/contact/normal_law.hpp"
#include "framework/protocol/drives.hpp"

namespace tack {

class DrivenLaw : public NormalLaw {
 public:
  // Both must outlive the law.
  DrivenLaw(std::shared_ptr<const NormalLaw> law, const Drive& drive)
      : law_(std::move(law)), drive_(&drive) {}

  std::string_view name() const override { return law_->name(); }
  void prepare(const PairMaterials&) override {}  // the law is prepared
  double range() const override { return law_->range(); }
  void add_samples(int n, const double* d, LawSample* out) const override {
    const double factor = drive_->now();
    std::vector<LawSample> whole(static_cast<size_t>(n));
    law_->add_samples(n, d, whole.data());
    for (int i = 0; i < n; ++i) {
      out[i].value += factor * whole[i].value;
      out[i].slope += factor * whole[i].slope;
      out[i].curvature += factor * whole[i].curvature;
    }
  }
  void add_values(int n, const double* d, double* out) const override {
    const double factor = drive_->now();
    std::vector<double> whole(static_cast<size_t>(n));
    law_->add_values(n, d, whole.data());
    for (int i = 0; i < n; ++i) out[i] += factor * whole[i];
  }
  std::unique_ptr<NormalLaw> clone() const override { return std::make_unique<DrivenLaw>(*this); }

 private:
  std::shared_ptr<const NormalLaw> law_;
  const Drive* drive_;
};

}  // namespace tack
