// A statistic of a series of samples: the number that an expectation compares.
//
// Samples with t0 <= t <= t1 count, with a slack of 1e-9 of the larger bound, because times are
// sums of steps. With s the abscissa, by default the time:
//    final     last sample
//    mean      average over time, (1/T) int p dt; the sample itself if there is only one
//    max, min  largest and smallest sample
//    peak      largest absolute value
//    integral  int p ds by the trapezoidal rule (work: a force along a displacement)
//    at        p where s first passes a given number, linear in between
//    deviation, rms_deviation, worst_deviation
//              mean, root mean square and largest deviation of p over s from a measured curve
//              (framework/measured), as fractions of the measured numbers; the run must pass every
//              point that counts
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/config/units.hpp"
#include "framework/measured/measured_data.hpp"
#include "framework/output/probes_csv.hpp"

namespace tack {

enum class Statistic {
  final,
  mean,
  max,
  min,
  peak,
  integral,
  at,
  deviation,
  rms_deviation,
  worst_deviation
};
inline constexpr Statistic all_statistics[] = {
    Statistic::final,         Statistic::mean,           Statistic::max, Statistic::min,
    Statistic::peak,          Statistic::integral,       Statistic::at,  Statistic::deviation,
    Statistic::rms_deviation, Statistic::worst_deviation};

std::string_view to_string(Statistic statistic);
bool is_deviation(Statistic statistic);  // one of the deviations

// A part of a run; its ends belong to it.
struct TimeWindow {
  double begin = 0, end = 0;  // s
};
// Windows in their order; nullopt: the whole run. Means, integrals, `at` and deviations take each
// window for itself: nothing is interpolated between windows.
using TimeWindows = std::optional<std::vector<TimeWindow>>;

struct StatisticQuery {
  Statistic statistic = Statistic::final;
  std::string probe;
  std::string along = "time";                // the column s, for integral, at and deviations
  double where = 0;                          // the value of s, for at
  std::vector<double> over;                  // {t0, t1} [s]; empty: all samples
  std::optional<MeasuredData> follows = {};  // for deviations
};

// A value, or NaN with the reason in `problem`: no samples, a sample that is not a number, an
// abscissa that never reaches `where`, measured data that cannot be read or are not covered by the
// run, a result that is not finite.
struct StatisticValue {
  double value;
  std::string problem;
  std::string detail = {};  // of deviations: number of points and position of the worst
};

// Returns the SI unit of a statistic of a column with unit `probe` along a column with unit
// `along`.
std::string unit_of(Statistic statistic, const Unit& probe, const Unit& along);

// Evaluates a statistic. Throws InputError, with the nearest name, if the series lacks a column.
StatisticValue evaluate(const StatisticQuery& query, const ProbeSeries& series,
                        const TimeWindows& windows = {});

// A run at the points of measured data; `run` is NaN where the run never gets.
struct MeasuredComparison {
  MeasuredCurve curve;
  std::vector<double> run;
};
// Evaluates a query with measured data. Throws InputError for data that cannot be read.
MeasuredComparison compare_with_measured(const StatisticQuery& query, const ProbeSeries& series,
                                         const TimeWindows& windows = {});

// Returns "peel_force: mean from 0.5 s to 1.2 s", "force: integral along gap".
std::string description(const StatisticQuery& query);

}  // namespace tack
