// Expectations of a scene on its run. In a scene file:
//    expect:
//      - {probe: peel_force, statistic: mean, over: [0.5, 1.2], target: 12.3, within: 5%}
//      - {probe: gap, statistic: min, at_least: 0}
//      - {probe: force, statistic: integral, along: gap, target: 0.02, within: 0.001}
//      - {probe: force, statistic: at, along: gap, where: 0.001, at_least: 1, at_most: 2}
//      - {probe: force, statistic: deviation, along: opening, at_most: 10%,
//         follows: {file: load.csv, from: 5 mm}}
// Numbers may have a unit of the probe's dimension (`target: 12 mN`), or for an integral of the
// product's; without unit they are SI. An expectation has either a target with tolerance, or
// bounds. Bounds and tolerance include their ends.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/field.hpp"
#include "framework/output/specified_statistic.hpp"

namespace tack {

struct Expectation : SpecifiedStatistic {
  std::string name;  // empty: generated from the other keys
  std::optional<Quantity> target;
  Value within;  // as written: "5%" or a number
  std::optional<Quantity> at_least;
  std::optional<Quantity> at_most;

  void fields(Fields& f);
};

struct ExpectationResult {
  std::string name;
  double value = 0;      // NaN if undefined
  double target = 0;     // NaN for bounds
  double tolerance = 0;  // absolute; NaN for bounds
  double at_least = 0;   // bounds of the accepted interval; -infinity and infinity where it is open
  double at_most = 0;
  bool pass = false;
  std::string text;  // "is 12.1, expected 12.3 within 0.615"
};

std::string name_of(const Expectation& expectation);

// Returns the absolute tolerance of `within` around a target. Throws InputError, without a source
// location, if it is negative, no number, or a percentage of a target of zero.
double tolerance_of(const Value& within, double target);

// Throws InputError, with the expectation and the nearest column, for an unknown column.
void check_columns(const Expectation& expectation, const std::vector<std::string>& columns);

// Checks units. units: one per column. Throws InputError, with the expectation and the key, for a
// number whose unit does not fit its column (or, for an integral, the product), and for measured
// data that cannot be read.
void check_units(const Expectation& expectation, const std::vector<std::string>& columns,
                 const std::vector<Unit>& units);

// Evaluates an expectation; a value that is not finite never passes. visits: the run's stages.
// Throws as check_columns does.
ExpectationResult evaluate(const Expectation& expectation, const ProbeSeries& series,
                           const std::vector<StageVisit>& visits = {});

}  // namespace tack
