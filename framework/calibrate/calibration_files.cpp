#include "framework/calibrate/calibration_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/output/csv.hpp"
#include "framework/output/file_names.hpp"
#include "framework/output/provenance_json.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

using Json = nlohmann::ordered_json;

Json finite(double number) { return std::isfinite(number) ? Json(number) : Json(); }

std::string cell(double number) { return std::isfinite(number) ? fmt::format("{}", number) : ""; }

Json parameter_json(const FittedParameter& n, size_t i, const Calibration& calibration, const CalibrateConfig& config) {
  Json keys = Json::object();
  for (size_t e = 0; e < n.keys.size(); ++e) keys[config.experiments[e].name] = n.keys[e];
  Json json{{"name", n.name}, {"keys", keys}, {"unit", n.unit == "1" ? "" : n.unit}, {"scale", n.log ? "log" : "linear"},
            {"from", n.from}, {"to", n.to},   {"start", six_digits(n.start)},       {"value", calibration.search.best.values[i]}};
  const auto& c = calibration.confidence;
  json["sigma"] = c ? finite(c->sigma[i]) : Json();
  json["low"] = c ? finite(c->low[i]) : Json();
  json["high"] = c ? finite(c->high[i]) : Json();
  json["determined"] = c && c->sigma[i] <= determined_sigma_max;
  const Derivatives& d = calibration.search.derivatives;
  json["derivatives"] = i < d.from_runs.size() && d.from_runs[i] ? "run" : "differences";
  json["why_differences"] = i < d.why.size() ? d.why[i] : "";
  return json;
}

Json experiment_json(const CalibrationFolder& folder, const MeasuredPoints& m, size_t k, const Calibration& calibration, const CalibrateConfig& config, const FittedScenes& scenes) {
  const MeasuredExperiment& e = config.experiments[k];
  const double misfit = calibration.search.best.misfits[k];
  const auto relative = [&](const std::filesystem::path& path) { return path.lexically_relative(folder.root).string(); };
  return {{"name", m.name},
          {"base", e.base},
          {"data", e.data},
          {"x", m.x},
          {"y", m.y},
          {"x_unit", m.x_unit == "1" ? "" : m.x_unit},
          {"y_unit", m.y_unit == "1" ? "" : m.y_unit},
          {"points", m.curve.size()},
          {"beyond", calibration.search.best.beyond[k]},
          {"misfit", misfit},
          {"rms", std::sqrt(misfit / m.weight / static_cast<double>(m.curve.size())) * m.scale},
          {"noise", m.noise_known ? Json(m.scale) : Json()},
          {"weight", m.weight},
          {"fit", relative(folder.fit(file_name(m.name)))},
          {"run", relative(folder.run(file_name(m.name)))},
          {"scene", relative(folder.scene(file_name(scenes.run_name(scenes.run_of(static_cast<int>(k))))))}};
}

Json search_json(const SearchResult& search, int started) {
  Json phases = Json::object();
  size_t failed = 0, with_derivatives = 0;
  for (const SearchRow& row : search.rows) {
    phases[row.phase] = phases.value(row.phase, 0) + 1;
    failed += row.evaluation.good ? 0 : 1;
    with_derivatives += row.evaluation.asked_derivatives ? 1 : 0;
  }
  return {{"started", started}, {"points", search.rows.size()}, {"failed", failed}, {"phases", phases}, {"with_derivatives", with_derivatives}};
}

std::string description(const CalibrationFolder& folder, const CalibrationRecord& r, const Calibration& calibration, const FittedScenes& scenes) {
  Json json{{"name", r.config.name}, {"about", r.config.about}, {"file", r.file}, {"provenance", to_json(r.provenance)},
            {"status", "done"}, {"wall_seconds", r.wall_seconds}, {"runs", search_json(calibration.search, r.started)}, {"misfit", calibration.search.best.misfit}};
  const auto& c = calibration.confidence;
  json["noise"] = {{"known", scenes.noise_known()}, {"of_residuals", c ? finite(c->noise) : Json()}};
  if (c) json["residuals"] = {{"points", c->residuals.points}, {"effective_points", finite(c->residuals.effective_points)}, {"correlation", c->residuals.correlation},
                              {"chi_squared", scenes.noise_known() ? finite(c->residuals.chi_squared) : Json()}, {"chi_squared_limit", finite(c->residuals.chi_squared_limit)}};
  json["fits"] = c && c->fits;
  json["numbers"] = Json::array();
  for (size_t i = 0; i < scenes.parameters().size(); ++i) json["numbers"].push_back(parameter_json(scenes.parameters()[i], i, calibration, r.config));
  json["derivatives"] = {{"missed", calibration.search.derivatives.missed}, {"compared", calibration.search.derivatives.compared}};
  json["correlation"] = Json::array();
  json["combinations"] = Json::array();
  if (c) {
    for (long i = 0; i < c->correlation.rows(); ++i) {
      Json row = Json::array();
      for (long k = 0; k < c->correlation.cols(); ++k) row.push_back(finite(c->correlation(i, k)));
      json["correlation"].push_back(row);
    }
    for (const DeterminedCombination& one : c->combinations) json["combinations"].push_back({{"text", one.text}, {"sigma", finite(one.sigma)}, {"weights", one.weights}});
  }
  json["experiments"] = Json::array();
  for (size_t k = 0; k < scenes.measured().size(); ++k) json["experiments"].push_back(experiment_json(folder, scenes.measured()[k], k, calibration, r.config, scenes));
  json["warnings"] = std::vector<std::string>(calibration.warnings.begin(), calibration.warnings.end());
  json["warning_kinds"] = Json::array();
  for (const Warning& warning : calibration.warnings) json["warning_kinds"].push_back(entry_of(warning.kind).key);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string parameters_csv(const Calibration& calibration, const FittedScenes& scenes) {
  std::string text = "name,unit,value,low,high,sigma,determined\n";
  const auto& c = calibration.confidence;
  for (size_t i = 0; i < scenes.parameters().size(); ++i) {
    const FittedParameter& n = scenes.parameters()[i];
    text += fmt::format("{},{},{},{},{},{},{}\n", csv_cell(n.name), csv_cell(n.unit == "1" ? "" : n.unit), calibration.search.best.values[i], c ? cell(c->low[i]) : "",
                        c ? cell(c->high[i]) : "", c ? cell(c->sigma[i]) : "", c && c->sigma[i] <= determined_sigma_max ? 1 : 0);
  }
  return text;
}

std::string evaluations_csv(const SearchResult& search, const FittedScenes& scenes) {
  std::string text = "number,phase";
  for (const FittedParameter& n : scenes.parameters()) text += "," + csv_cell(n.name);
  text += ",misfit";
  if (scenes.measured().size() > 1)
    for (const MeasuredPoints& m : scenes.measured()) text += "," + csv_cell("misfit:" + m.name);
  text += ",derivatives,status,error\n";
  for (size_t i = 0; i < search.rows.size(); ++i) {
    const PointEvaluation& e = search.rows[i].evaluation;
    text += fmt::format("{},{}", i + 1, csv_cell(search.rows[i].phase));
    for (const double value : e.values) text += fmt::format(",{}", value);
    text += "," + cell(e.misfit);
    if (scenes.measured().size() > 1)
      for (size_t k = 0; k < scenes.measured().size(); ++k) text += "," + (e.good ? cell(e.misfits[k]) : std::string());
    text += fmt::format(",{},{},{}\n", e.asked_derivatives ? 1 : 0, csv_cell(e.status), csv_cell(e.error));
  }
  return text;
}

void write_curves(const CalibrationFolder& folder, const MeasuredPoints& m, const ProbeSeries& run) {
  int beyond = 0;
  const std::vector<double> simulated = m.simulated(run, beyond);
  std::string fit = fmt::format("{},measured,simulated\n", csv_cell(m.x));
  for (size_t i = 0; i < simulated.size(); ++i) fit += fmt::format("{},{},{}\n", m.curve.x[i], m.curve.y[i], simulated[i]);
  replace_file(folder.fit(file_name(m.name)), fit);
  std::string whole = fmt::format("{},simulated\n", csv_cell(m.x));
  for (const auto& row : run.rows) whole += fmt::format("{},{}\n", row[*run.column(m.x)], row[*run.column(m.y)]);
  replace_file(folder.run(file_name(m.name)), whole);
}

}  // namespace

void write_calibration(const CalibrationFolder& folder, const CalibrationRecord& record, const Calibration& calibration, FittedScenes& scenes,
                       const std::vector<std::filesystem::path>& best_runs) {
  for (int run = 0; run < scenes.runs(); ++run)
    replace_file(folder.scene(file_name(scenes.run_name(run))), scenes.scene_text(run, calibration.search.best.values));
  for (size_t k = 0; k < scenes.measured().size(); ++k)
    write_curves(folder, scenes.measured()[k], read_csv(best_runs[static_cast<size_t>(scenes.run_of(static_cast<int>(k)))] / "probes.csv"));
  replace_file(folder.table(), evaluations_csv(calibration.search, scenes));
  replace_file(folder.parameters(), parameters_csv(calibration, scenes));
  replace_file(folder.description(), description(folder, record, calibration, scenes));
}

}  // namespace tack
