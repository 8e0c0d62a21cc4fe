#include "framework/output/expectations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Returns "" if the expectation has exactly one criterion; else the error.
std::string check_criterion(const Expectation& e) {
  const bool bounded = e.at_least || e.at_most;
  if (!e.target && !bounded) return "needs target with within, or at_least or at_most";
  if (e.target && bounded) return "either target with within, or at_least and at_most, not both";
  if (!e.target && !e.within.is_null()) return "within needs a target";
  if (e.target && e.within.is_null()) return "target needs within, such as 5% or 0.01";
  if (e.at_least && e.at_most && *e.at_least > *e.at_most) return "at_least is above at_most";
  return "";
}

std::string check_tolerance(const Expectation& e) {
  try {
    if (e.target && !e.within.is_null()) tolerance_of(e.within, *e.target);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

void set_interval(ExpectationResult& result, const Expectation& e) {
  const auto bound = [](const std::optional<Quantity>& q, double open) { return q ? q->si : open; };
  result.target = bound(e.target, nan);
  result.tolerance = e.target ? tolerance_of(e.within, *e.target) : nan;
  result.at_least = e.target ? *e.target - result.tolerance : bound(e.at_least, -infinity);
  result.at_most = e.target ? *e.target + result.tolerance : bound(e.at_most, infinity);
}

std::string criterion_text(const ExpectationResult& r) {
  if (!std::isnan(r.target)) return fmt::format("{:.6g} within {:.6g}", r.target, r.tolerance);
  if (r.at_most == infinity) return fmt::format("at least {:.6g}", r.at_least);
  if (r.at_least == -infinity) return fmt::format("at most {:.6g}", r.at_most);
  return fmt::format("from {:.6g} to {:.6g}", r.at_least, r.at_most);
}

// Around a target the difference is compared, so that `within: 0` and a difference equal to the
// tolerance do not depend on the rounding of target + tolerance.
bool accepted(const ExpectationResult& r) {
  if (!std::isfinite(r.value)) return false;
  if (!std::isnan(r.target)) return std::abs(r.value - r.target) <= r.tolerance;
  return r.value >= r.at_least && r.value <= r.at_most;
}

}  // namespace

void Expectation::fields(Fields& f) {
  f.text("name", name, "name in reports; made from the other keys if empty").line();
  SpecifiedStatistic::fields(f);
  f.optional_quantity("target", target,
                      "expected value, in a unit of the probe's kind; for 'integral', of probe times `along`");
  f.raw("within", within, "tolerance of the target: a number of the same kind, or a percentage of the target");
  f.optional_quantity("at_least", at_least, "smallest value accepted, in a unit of the target's kind");
  f.optional_quantity("at_most", at_most, "largest value accepted, in a unit of the target's kind");
  f.check("target", [this] { return check_criterion(*this); });
  f.check("within", [this] { return check_tolerance(*this); });
}

std::string name_of(const Expectation& e) {
  return e.name.empty() ? e.description() : e.name;
}

double tolerance_of(const Value& within, double target) {
  if (!within.is_scalar()) {
    throw InputError("expects a number or a percentage, got " + within.description());
  }
  const double number = to_si(within.text, units::any);
  if (number < 0) throw InputError(fmt::format("'{}' must not be negative", within.text));
  if (within.text.find('%') == std::string::npos) return number;
  if (target != 0) return number * std::abs(target);
  throw InputError(
      fmt::format("'{}' of a target of 0 is nothing; give a number in the SI unit of "
                  "the probe instead",
                  within.text));
}

void check_columns(const Expectation& expectation, const std::vector<std::string>& columns) {
  evaluate(expectation, ProbeSeries{columns, {}});
}

namespace {

// Returns the unit of a column; a plain number for an unknown column.
Unit unit_of(const std::string& column, const std::vector<std::string>& columns, const std::vector<Unit>& units) {
  const auto at = std::find(columns.begin(), columns.end(), column);
  return at == columns.end() ? units::none : units[static_cast<std::size_t>(at - columns.begin())];
}

}  // namespace

void check_units(const Expectation& e, const std::vector<std::string>& columns, const std::vector<Unit>& units) {
  const Unit probe = unit_of(e.query.probe, columns, units), along = unit_of(e.query.along, columns, units);
  const std::string si = unit_of(e.query.statistic, probe, along);
  const Unit unit{si, e.query.statistic == Statistic::integral ? "integral" : is_deviation(e.query.statistic) ? "number" : probe.quantity};
  const auto check = [&](const char* key, const auto& test) {
    try {
      test();
    } catch (const InputError& error) {
      throw InputError(fmt::format("expectation '{}': {}: {}", name_of(e), key, error.what()));
    }
  };
  check("target", [&] { if (e.target) e.target->check(unit); });
  check("at_least", [&] { if (e.at_least) e.at_least->check(unit); });
  check("at_most", [&] { if (e.at_most) e.at_most->check(unit); });
  check("where", [&] { if (e.where) e.where->check(along); });
  if (const auto& data = e.query.follows) {
    check("from", [&] { if (data->from) data->from->check(along); });
    check("to", [&] { if (data->to) data->to->check(along); });
    check("follows", [&] { data->read(e.query.along, along, e.query.probe, probe); });
  }
  const bool absolute = e.within.is_scalar() && e.within.text.find('%') == std::string::npos;
  check("within", [&] { if (absolute) to_si(e.within.text, unit); });
}

ExpectationResult evaluate(const Expectation& expectation, const ProbeSeries& series, const std::vector<StageVisit>& visits) {
  ExpectationResult result;
  result.name = name_of(expectation);
  set_interval(result, expectation);
  StatisticValue found;
  try {
    found = expectation.value(series, visits);
  } catch (const InputError& error) {
    throw InputError(fmt::format("expectation '{}': {}", result.name, error.what()));
  }
  result.value = found.value;
  result.pass = accepted(result);
  const std::string is =
      !found.problem.empty() ? found.problem : found.detail.empty() ? fmt::format("is {:.6g}", found.value) : fmt::format("is {:.6g} ({})", found.value, found.detail);
  result.text = fmt::format("{}, expected {}", is, criterion_text(result));
  return result;
}

}  // namespace tack
