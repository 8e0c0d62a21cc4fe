// What a scene says its run must show. In a scene file:
//   expect:
//     - {probe: peel_force, statistic: mean, over: [0.5, 1.2], target: 12.3, within: 5%}
//     - {probe: gap, statistic: min, at_least: 0}
//     - {probe: force, statistic: integral, along: gap, target: 0.02, within: 0.001}
//     - {probe: force, statistic: at, along: gap, where: 0.001, at_least: 1, at_most: 2}
//     - {probe: force, statistic: deviation, along: opening, follows: {file: load.csv, from: 5 mm}, at_most: 10%}
// Numbers may carry a unit of the probe's kind (`target: 12 mN`), of the product of both for an integral; plain
// ones are SI. Either a target with its tolerance, or bounds; both bounds and tolerance include their ends.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/field.hpp"
#include "framework/output/specified_statistic.hpp"

namespace tack {

struct Expectation : SpecifiedStatistic {
  std::string name;  // empty: made from the rest
  std::optional<Quantity> target;
  Value within;  // as written: "5%" or a number
  std::optional<Quantity> at_least;
  std::optional<Quantity> at_most;

  void fields(Fields& f);
};

struct ExpectationResult {
  std::string name;
  double value = 0;      // NaN if there is none
  double target = 0;     // NaN for bounds
  double tolerance = 0;  // absolute; NaN for bounds
  double at_least = 0;   // the accepted interval; -infinity and infinity where it is open
  double at_most = 0;
  bool pass = false;
  std::string text;  // "is 12.1, expected 12.3 within 0.615"
};

std::string name_of(const Expectation& expectation);

// The absolute tolerance of `within` around a target. Throws InputError, without a place, if it is
// negative, no number, or a percentage of a target of zero.
double tolerance_of(const Value& within, double target);

// Throws InputError, naming the expectation and the nearest column, for a column that is not there.
void check_columns(const Expectation& expectation, const std::vector<std::string>& columns);

// Throws InputError, naming the expectation and the key, for a number whose unit is not of the kind of its
// column, or of the product of both for an integral; also for measured data that cannot be read. `units`: of each of `columns`.
void check_units(const Expectation& expectation, const std::vector<std::string>& columns,
                 const std::vector<Unit>& units);

// Never passes without a finite number to compare. Throws as check_columns does.
ExpectationResult evaluate(const Expectation& expectation, const ProbeSeries& series);

}  // namespace tack
