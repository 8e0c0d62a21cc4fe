// A law without force, which has a range: for tests of geometry alone.
#pragma once

#include "framework/contact/laws/pair_law.hpp"

namespace tack {

class FlatLaw : public NormalLaw {
 public:
  explicit FlatLaw(double range) : range_(range) {}
  std::string_view name() const override { return "flat"; }
  void prepare(const PairMaterials& /*materials*/) override {}
  double range() const override { return range_; }
  void add_samples(int /*n*/, const double* /*d*/, LawSample* /*out*/) const override {}
  void add_values(int /*n*/, const double* /*d*/, double* /*out*/) const override {}
  std::unique_ptr<NormalLaw> clone() const override { return std::make_unique<FlatLaw>(range_); }

 private:
  double range_;  // m
};

inline PairLaw flat_law(double range) {
  PairLaw law;
  law.add(std::make_shared<FlatLaw>(range));
  return law;
}

}  // namespace tack
