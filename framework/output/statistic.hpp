// One number out of a series of samples: what an expectation compares.
//
// The samples with t0 <= t <= t1 count (with a slack of 1e-9 of the larger bound, since times are
// sums of steps). With s the chosen abscissa, by default the time:
//   final     last sample
//   mean      average over time, (1/T) int p dt; the sample itself if there is only one
//   max, min  largest and smallest sample
//   peak      largest absolute value
//   integral  int p ds by the trapezoidal rule (work: a force along a displacement)
//   at        p where s first passes a given number, linear in between
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "framework/config/units.hpp"
#include "framework/output/probes_csv.hpp"

namespace tack {

enum class Statistic { final, mean, max, min, peak, integral, at };

std::string_view to_string(Statistic statistic);

struct StatisticQuery {
  Statistic statistic = Statistic::final;
  std::string probe;
  std::string along = "time";  // the column s, for integral and at
  double where = 0;            // the value of s, for at
  std::vector<double> over;    // {t0, t1} [s]; empty: all samples
};

// NaN and the reason in `problem` if there is no such number: no samples, a sample that is not a
// number, an abscissa that never reaches the value, a result that is not finite.
struct StatisticValue {
  double value;
  std::string problem;
};

// The SI unit of a statistic of a column, along another, that have those.
std::string unit_of(Statistic statistic, const Unit& probe, const Unit& along);

// Throws InputError, with the nearest name, if the series lacks a column.
StatisticValue evaluate(const StatisticQuery& query, const ProbeSeries& series);

// "peel_force: mean from 0.5 s to 1.2 s", "force: integral along gap".
std::string description(const StatisticQuery& query);

}  // namespace tack
