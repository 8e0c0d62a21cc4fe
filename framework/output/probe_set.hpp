// The probes of a run: instances of those that an experiment specifies, ready for one world.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/output/expectations.hpp"
#include "framework/output/probe.hpp"

namespace tack {

class ProbeSet {
 public:
  // `root`: the parsed file. Throws InputError with the place in it.
  ProbeSet(const std::vector<std::unique_ptr<const Probe>>& specified, const Value& root, const World& world);

  const std::vector<std::string>& columns() const { return columns_; }  // without time
  // Throws InputError, with the place, for an expectation that these columns and their units do not fit.
  void check(const std::vector<Expectation>& expectations, const Value& root) const;
  // A value per column, at an accepted state.
  std::vector<double> sample(const World& world, const State& state);
  // What the samples since the last call were the first to have no finite number of, "stress is nan"; infinities that are meant do not count.
  std::vector<std::string> take_lost();

 private:
  std::vector<std::unique_ptr<Probe>> probes_;
  std::vector<std::string> columns_;
  std::vector<Unit> units_;      // of the columns
  std::vector<char> unbounded_;  // likewise: infinity is one of their values
  std::vector<char> told_;       // likewise: a sample was no finite number
  std::vector<std::string> lost_;
};

}  // namespace tack
