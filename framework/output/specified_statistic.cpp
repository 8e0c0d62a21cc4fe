#include "framework/output/specified_statistic.hpp"

#include <fmt/format.h>

namespace tack {
namespace {

std::string check_window(const std::vector<double>& over) {
  if (over.empty() || (over.size() == 2 && over[0] <= over[1])) return "";
  return "expects the first and the last time [t0, t1] with t0 not above t1";
}

std::string check_abscissa(const SpecifiedStatistic& e) {
  const bool at = e.query.statistic == Statistic::at;
  if (at && !e.where) return "statistic 'at' needs where, the value of along at which it is taken";
  if (!at && e.where) return "only statistic 'at' uses it; remove it or change the statistic";
  return "";
}

std::string check_along(const SpecifiedStatistic& e) {
  const Statistic s = e.query.statistic;
  const bool used = s == Statistic::at || s == Statistic::integral || is_deviation(s);
  if (used || e.query.along == "time") return "";
  return "only the statistics 'integral' and 'at', and deviations, use it; remove it or change the statistic";
}

std::string check_data(const SpecifiedStatistic& e) {
  const Statistic s = e.query.statistic;
  if (is_deviation(s) && !e.query.follows) return fmt::format("statistic '{}' needs follows, the measured curve: {{file: load.csv}}, say", to_string(s));
  if (!is_deviation(s) && e.query.follows) return "only 'deviation', 'rms_deviation' and 'worst_deviation' use it; remove it or change the statistic";
  return "";
}

std::vector<Choice<Statistic>> statistics() {
  using enum Statistic;
  return {{"final", final, "the last sample"},
          {"mean", mean, "the average over time"},
          {"max", max, "the largest sample"},
          {"min", min, "the smallest sample"},
          {"peak", peak, "the largest absolute value"},
          {"integral", integral, "the integral along a column, by the trapezoidal rule"},
          {"at", at, "the value where the column `along` first passes `where`"},
          {"deviation", deviation, "relative deviation from the measured curve `follows`, mean over its points; 0.1 for 10%"},
          {"rms_deviation", rms_deviation, "root mean square of the relative deviation"},
          {"worst_deviation", worst_deviation, "largest relative deviation"}};
}

}  // namespace

void SpecifiedStatistic::fields(Fields& f) {
  f.text("probe", query.probe, "column of probes.csv").required();
  f.choice("statistic", query.statistic, statistics(), "statistic that is compared").required();
  f.numbers("over", query.over, units::time, "first and last time that count; empty for all");
  f.text("along", query.along, "column to integrate over, in which to find `where`, or over which data were measured");
  f.optional_quantity("where", where, "value of the column `along`, for 'at', in a unit of that column's kind");
  f.optional_object("follows", query.follows, "measured curve for deviations; its abscissa is the column `along`");
  f.text("stage", stage, "stage of a protocol: the statistic is that of the samples in this stage, every time that it is run through");
  f.check("over", [this] { return check_window(query.over); });
  f.check("along", [this] { return check_along(*this); });
  f.check("where", [this] { return check_abscissa(*this); });
  f.check("follows", [this] { return check_data(*this); });
}

StatisticQuery SpecifiedStatistic::resolved() const {
  StatisticQuery resolved = query;
  if (where) resolved.where = *where;
  return resolved;
}

std::string SpecifiedStatistic::description() const {
  const std::string text = tack::description(resolved());
  return stage.empty() ? text : fmt::format("{} in stage {}", text, stage);
}

TimeWindows SpecifiedStatistic::windows(const std::vector<StageVisit>& visits) const {
  if (stage.empty()) return std::nullopt;
  return windows_of_stage(visits, stage);
}

StatisticValue SpecifiedStatistic::value(const ProbeSeries& series, const std::vector<StageVisit>& visits) const {
  return evaluate(resolved(), series, windows(visits));
}

}  // namespace tack
