#include "framework/calibrate/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/config/words.hpp"

namespace tack {
namespace {

std::string unit_text(const std::string& unit) { return unit == "1" ? "" : " " + unit; }

// Returns the remedy for data of which the run reaches less than half.
std::string far_off(const std::vector<double>& x) {
  const auto [least, largest] = std::minmax_element(x.begin(), x.end());
  return fmt::format("they go from {:.4g} to {:.4g} in SI: check the unit and the sign of that column, and what the run reaches", *least, *largest);
}

}  // namespace

std::vector<Warning> warnings_about(const SearchResult& search, const std::vector<MeasuredPoints>& measured) {
  std::vector<Warning> warnings;
  if (!search.derivatives.problem.empty()) warnings.emplace_back(WarningKind::no_intervals, fmt::format("no confidence intervals: {}", search.derivatives.problem));
  for (size_t i = 0; i < measured.size(); ++i)
    if (const int missed = search.best.beyond[i]; missed > 0)
      warnings.emplace_back(WarningKind::missed_points,
                            fmt::format("the best run does not reach {} of {} points of {} ({} over {}), and is compared there at its nearest sample; {}", missed,
                                        measured[i].curve.size(), measured[i].curve.path, measured[i].y, measured[i].x,
                                        2 * missed > static_cast<int>(measured[i].curve.size()) && measured[i].curve.size() > 0 ? far_off(measured[i].curve.x) : "exclude the points with from and to, or extend the run"));
  const auto failed = std::count_if(search.rows.begin(), search.rows.end(), [](const SearchRow& row) { return !row.evaluation.good; });
  if (failed > 0)
    warnings.emplace_back(WarningKind::failed_points, fmt::format("{} of {} evaluations failed; evaluations.csv has the reasons", failed, search.rows.size()));
  return warnings;
}

Calibration calibrate(const FittedScenes& scenes, const SearchConfig& config, Evaluator& evaluator, const SearchProgress& progress) {
  Calibration calibration{search_for(scenes.parameters(), config, evaluator, progress, scenes.noise_known()), {}, {}};
  const SearchResult& s = calibration.search;
  if (s.derivatives.problem.empty()) {
    std::vector<size_t> series;
    for (const MeasuredPoints& m : scenes.measured()) series.push_back(m.curve.size());
    calibration.confidence = find_confidence(scenes.parameters(), s.best.values, s.derivatives.jacobian, s.best.residuals, scenes.noise_known(), series);
    calibration.warnings = calibration.confidence->warnings;
  }
  for (Warning& warning : warnings_about(s, scenes.measured())) calibration.warnings.push_back(std::move(warning));
  return calibration;
}

std::string sensitivities_text(const SearchResult& search, const std::vector<FittedParameter>& parameters) {
  const Derivatives& d = search.derivatives;
  std::string text;
  std::vector<std::string> own;
  for (size_t i = 0; i < parameters.size(); ++i)
    if (i < d.from_runs.size() && d.from_runs[i]) own.push_back(parameters[i].name);
  if (!own.empty())
    text += fmt::format("  sensitivities to {} from the run{}\n", listed(own),
                        d.compared > 0 ? fmt::format("; unexplained: {:.2g}% of the differences to {}", 100 * d.missed, counted(d.compared, "nearby evaluation")) : "");
  for (size_t i = 0; i < parameters.size(); ++i)
    if (i < d.why.size() && !d.why[i].empty()) text += fmt::format("  sensitivities to {} by finite differences: {}\n", parameters[i].name, d.why[i]);
  return text;
}

std::string summary_text(const Calibration& calibration, const FittedScenes& scenes) {
  const DesignPoint& best = calibration.search.best.values;
  std::string text;
  size_t width = 0;
  for (const FittedParameter& n : scenes.parameters()) width = std::max(width, n.name.size());
  for (size_t i = 0; i < best.size(); ++i) {
    const FittedParameter& n = scenes.parameters()[i];
    text += fmt::format("  {:<{}}  {:.6g}{}", n.name, width, best[i], unit_text(n.unit));
    if (const auto& c = calibration.confidence; c && std::isfinite(c->sigma[i]))
      text += n.log ? fmt::format("  (95%: {:.4g} to {:.4g}; standard deviation {:.2g}%)", c->low[i], c->high[i], 100 * c->sigma[i])
                    : fmt::format("  (95%: {:.4g} to {:.4g})", c->low[i], c->high[i]);
    text += "\n";
  }
  for (size_t k = 0; k < scenes.measured().size(); ++k) {
    const MeasuredPoints& m = scenes.measured()[k];
    const double rms = std::sqrt(calibration.search.best.misfits[k] / m.weight / static_cast<double>(m.curve.size()));
    text += fmt::format("  {}: RMS residual {:.3g}{} ({}){}\n", m.name, rms * m.scale, unit_text(m.y_unit),
                        counted(static_cast<long>(m.curve.size()), "point"), m.noise_known ? fmt::format(", {:.3g} times the noise", rms) : fmt::format(", {:.3g}% of the largest", 100 * rms));
  }
  text += sensitivities_text(calibration.search, scenes.parameters());
  for (const Warning& warning : calibration.warnings) text += "warning: " + warning.text + "\n";
  return text;
}

}  // namespace tack
