#include "framework/law/rate_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/law/bond_study.hpp"
#include "framework/plot/axis_unit.hpp"

namespace tack {
namespace {

constexpr double least_speed = 1e-8, decades = 16;  // of the opening of failure, per second
constexpr int points_per_decade = 3;
constexpr double change = 0.1;  // of the quasi-static value: a rate effect
constexpr int points_per_opening = 400;  // of the opening of failure
constexpr int longest_path = 16;         // in openings of failure
constexpr double traction_end = 1e-3;    // of the peak: the bond has failed
constexpr double explicit_substeps = 20;  // longest steps within a point of the path

using Metric = double RatePoint::*;

// One bond law, opened in one direction.
struct Opened {
  const BondLaw& law;
  double angle, opening_end;

  RatePoint at(double speed) const {
    RatePoint result{speed};
    for (int openings = 1; openings <= longest_path; openings *= 2) {
      const auto path = pull_bond(law, {openings * opening_end}, angle, openings * points_per_opening, speed);
      result.peak = result.work = 0;
      double traction_before = 0, displacement_before = 0;
      for (const BondPoint& p : path) {
        const double traction = traction_along(p, angle), displacement = displacement_of(p);
        result.peak = std::max(result.peak, traction);
        result.work += (traction + traction_before) / 2 * (displacement - displacement_before);
        traction_before = traction, displacement_before = displacement;
      }
      if (traction_before < traction_end * result.peak) break;
    }
    return result;
  }
};

bool changed(double value, double slow) { return std::abs(value - slow) > change * slow; }

// Returns the speed [m/s] between two points of the scan at which a metric begins or ceases to differ.
double crossing(const Opened& opened, Metric metric, double slow, double low, double high) {
  const bool at_low = changed(opened.at(low).*metric, slow);
  for (int i = 0; i < 20; ++i) {
    const double middle = std::sqrt(low * high);
    (changed(opened.at(middle).*metric, slow) == at_low ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

// Refines an extremum at an inner point k of the scan: golden section in the logarithm of the speed. sign: 1 for the
// largest value, -1 for the smallest.
RatePoint refined(const Opened& opened, Metric metric, double sign, const std::vector<RatePoint>& points, size_t k) {
  RatePoint best = points[k];
  double a = std::log(points[k - 1].speed), b = std::log(points[k + 1].speed);
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  for (int i = 0; i < 16; ++i) {
    const double c = b - ratio * (b - a), d = a + ratio * (b - a);
    const RatePoint at_c = opened.at(std::exp(c)), at_d = opened.at(std::exp(d));
    for (const RatePoint& p : {at_c, at_d})
      if (sign * p.*metric > sign * best.*metric) best = p;
    (sign * at_c.*metric > sign * at_d.*metric ? b : a) = sign * at_c.*metric > sign * at_d.*metric ? d : c;
  }
  return best;
}

struct Extremum {
  RatePoint point;
  bool inner = false;  // within the range of the scan
};

Extremum extremum_of(const Opened& opened, Metric metric, double sign, const RateScan& scan) {
  const auto& points = scan.points;
  size_t k = 0;
  for (size_t i = 1; i < points.size(); ++i)
    if (sign * points[i].*metric > sign * points[k].*metric) k = i;
  // A plateau at either end, to which the law tends, is no maximum within the range.
  const double level = points[k].*metric, tolerance = 1e-3 * level;
  const bool inner = k > 0 && k + 1 < points.size() && std::abs(points.front().*metric - level) > tolerance && std::abs(points.back().*metric - level) > tolerance;
  if (inner) return {refined(opened, metric, sign, points, k), true};
  return {std::abs(points.back().*metric - level) <= tolerance ? points.back() : points.front()};
}

// Appends the quantities of one metric. Returns its largest value.
Extremum describe(const Opened& opened, const char* name, const char* unit, Metric metric, RateScan& scan, std::vector<KeyQuantity>& quantities) {
  const double slow = scan.slow.*metric;
  std::vector<double> crossings;  // m/s, ascending
  for (size_t i = 0; i < scan.points.size(); ++i) {
    const bool now = changed(scan.points[i].*metric, slow), before = i > 0 && changed(scan.points[i - 1].*metric, slow);
    if (now != before) crossings.push_back(i == 0 ? scan.points[0].speed : crossing(opened, metric, slow, scan.points[i - 1].speed, scan.points[i].speed));
  }
  const Extremum largest = extremum_of(opened, metric, 1, scan);
  if (crossings.empty()) return largest;
  scan.effect_speed = std::min(scan.effect_speed, crossings.front());
  std::string remark = fmt::format("10% off the quasi-static {}", name);
  for (size_t i = 1; i < crossings.size(); ++i)
    remark += fmt::format("{} {}", i % 2 ? "; back within 10% from" : "; off again from", with_axis_unit(crossings[i], "m/s"));
  quantities.push_back({fmt::format("speed that changes the {}", name), crossings.front(), "m/s", remark});
  const auto say = [&](const char* which, const Extremum& found) {
    const double ratio = found.point.*metric / slow;
    quantities.push_back({fmt::format("{} {} at speed", which, name), found.point.*metric, unit,
                          fmt::format("{:.3g} of the quasi-static one, at {}{}", ratio, with_axis_unit(found.point.speed, "m/s"), found.inner ? "" : ", at the end of the scan")});
  };
  if (largest.point.*metric > (1 + change) * slow) say("largest", largest);
  if (const Extremum smallest = extremum_of(opened, metric, -1, scan); smallest.point.*metric < (1 - change) * slow) say("smallest", smallest);
  return largest;
}

}  // namespace

bool RateScan::rate_dependent() const { return std::isfinite(effect_speed); }

RateScan scan_rates(const BondLaw& law, double angle, double opening_end, std::vector<KeyQuantity>& quantities) {
  const Opened opened{law, angle, opening_end};
  RateScan scan;
  scan.effect_speed = std::numeric_limits<double>::infinity();
  scan.slow = opened.at(0);
  const double fastest = opening_end * least_speed * std::pow(10, decades);
  double slowest = opening_end * least_speed;
  if (std::isfinite(law.longest_step())) slowest = std::max(slowest, opening_end / points_per_opening / (explicit_substeps * law.longest_step()));
  const int points = std::max(2, static_cast<int>(std::lround(points_per_decade * std::log10(fastest / slowest))));
  for (int i = 0; i <= points; ++i) scan.points.push_back(opened.at(slowest * std::pow(fastest / slowest, double(i) / points)));
  std::vector<KeyQuantity> of_metrics;
  const Extremum peak = describe(opened, "peak", "Pa", &RatePoint::peak, scan, of_metrics);
  const Extremum work = describe(opened, "work", "J/m^2", &RatePoint::work, scan, of_metrics);
  for (const auto& [found, metric] : {std::pair{work, &RatePoint::work}, {peak, &RatePoint::peak}})
    if (scan.largest_speed == 0 && found.inner && found.point.*metric > (1 + change) * scan.slow.*metric) scan.largest_speed = found.point.speed;
  const std::string range = fmt::format("from {} to {}", with_axis_unit(slowest, "m/s"), with_axis_unit(fastest, "m/s"));
  quantities.push_back({"speed that tells", scan.effect_speed, "m/s",
                        scan.rate_dependent() ? "the smallest at which peak or work are 10% off their quasi-static values; scanned " + range
                                              : "independent of the rate: peak and work change by less than 10% " + range});
  quantities.insert(quantities.end(), of_metrics.begin(), of_metrics.end());
  return scan;
}

}  // namespace tack
