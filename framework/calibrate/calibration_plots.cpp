// Pictures of a calibration.
#include <cmath>

#include "framework/calibrate/calibration_files.hpp"
#include "framework/output/file_names.hpp"
#include "framework/plot/gnuplot.hpp"

namespace tack {
namespace {

std::string axis_unit_of(const std::string& unit) { return unit == "1" ? "" : unit; }

Curve curve_of(const CsvTable& table, const char* column, std::string title, bool scattered) {
  Curve curve{std::move(title), {}, {}, scattered};
  for (const auto& row : table.rows) curve.points.emplace_back(row[0], row[*table.column(column)]);
  return curve;
}

Plot fit_plot(const CalibrationFolder& folder, const MeasuredPoints& m) {
  Plot plot;
  plot.title = m.name;
  plot.x_label = m.x;
  plot.y_label = m.y;
  plot.x_unit = axis_unit_of(m.x_unit);
  plot.y_unit = axis_unit_of(m.y_unit);
  plot.style = Plot::Style::lines;
  plot.curves.push_back(curve_of(read_csv(folder.run(file_name(m.name))), "simulated", "simulated", false));
  plot.curves.push_back(curve_of(read_csv(folder.fit(file_name(m.name))), "measured", "measured", true));
  return plot;
}

// One curve per phase, over the number of the point.
Plot misfit_plot(const SearchResult& search) {
  Plot plot;
  plot.title = "misfit, from point to point";
  plot.x_label = "point";
  plot.y_label = "misfit";
  plot.log_y = true;
  for (size_t i = 0; i < search.rows.size(); ++i) {
    const SearchRow& row = search.rows[i];
    if (!row.evaluation.good) continue;
    if (plot.curves.empty() || plot.curves.back().title != row.phase) plot.curves.push_back({row.phase, {}, {}, true});
    plot.curves.back().points.emplace_back(static_cast<double>(i + 1), row.evaluation.misfit);
  }
  return plot;
}

}  // namespace

std::vector<std::string> draw_calibration(const CalibrationFolder& folder, const Calibration& calibration, const FittedScenes& scenes) {
  std::vector<std::string> failures;
  const auto add = [&](const Plot& plot, const std::string& name) {
    if (std::string failure = draw(plot, folder.plots(), name); !failure.empty()) failures.push_back(std::move(failure));
  };
  for (const MeasuredPoints& m : scenes.measured()) add(fit_plot(folder, m), "fit_" + file_name(m.name));
  add(misfit_plot(calibration.search), "misfit");
  return failures;
}

}  // namespace tack
