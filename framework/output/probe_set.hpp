// The probes of a run: instances of the experiment's probes, prepared for one world.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/output/expectations.hpp"
#include "framework/output/probe.hpp"

namespace tack {

class ProbeSet {
 public:
  // root: the parsed file. Throws InputError with the source location.
  ProbeSet(const std::vector<std::unique_ptr<const Probe>>& specified, const Value& root,
           const World& world);

  const std::vector<std::string>& columns() const { return columns_; }  // without time
  const std::vector<Unit>& units() const { return units_; }             // of the columns
  // Throws InputError, with the source location, for an expectation that does not fit the columns
  // and their units.
  void check(const std::vector<Expectation>& expectations, const Value& root) const;
  // Returns one value per column, at an accepted state.
  std::vector<double> sample(const World& world, const State& state);
  // Returns, as "stress is nan", columns that became invalid since the last call: samples that are
  // not finite, except valid infinities. Each column is returned once.
  std::vector<std::string> take_invalid();

 private:
  std::vector<std::unique_ptr<Probe>> probes_;
  std::vector<std::string> columns_;
  std::vector<Unit> units_;      // per column
  std::vector<char> unbounded_;  // per column: infinity is a valid value
  std::vector<char> reported_;   // per column: reported as invalid
  std::vector<std::string> invalid_;
};

}  // namespace tack
