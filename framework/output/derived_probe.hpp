// A probe computed from other probes: a function of the columns of probes that precede it.
#pragma once

#include <span>

#include "framework/output/probe.hpp"

namespace tack {

class DerivedProbe : public Probe {
 public:
  // Finds its arguments. columns: of the probes before, after "time". Throws InputError, without a
  // source location.
  virtual void find(const std::vector<std::string>& columns) = 0;
  // Returns its value. values: of these columns, time first.
  virtual double of(std::span<const double> values) const = 0;

  void prepare(const World&) final {}
  // unused: ProbeSet calls of()
  std::vector<double> sample(const World&, const State&) final { return {}; }
};

}  // namespace tack
