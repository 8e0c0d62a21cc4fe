// A probe of other probes: a function of the columns of those before it in the list.
#pragma once

#include <span>

#include "framework/output/probe.hpp"

namespace tack {

class DerivedProbe : public Probe {
 public:
  // `columns` of the probes before, behind "time". Throws InputError, without a place.
  virtual void find(const std::vector<std::string>& columns) = 0;
  // Their values, the time first.
  virtual double of(std::span<const double> values) const = 0;

  void prepare(const World&) final {}
  std::vector<double> sample(const World&, const State&) final { return {}; }  // the set of probes asks of() instead
};

}  // namespace tack
