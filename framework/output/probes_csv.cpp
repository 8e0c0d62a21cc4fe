#include "framework/output/probes_csv.hpp"

#include <fmt/format.h>

#include "geometry/errors.hpp"

namespace tack {
namespace {

ProbeSeries empty_series(const std::vector<std::string>& columns) {
  ProbeSeries series{{"time"}, {}};
  series.columns.insert(series.columns.end(), columns.begin(), columns.end());
  return series;
}

}  // namespace

ProbesCsv::ProbesCsv(std::filesystem::path path, ProbeSeries series)
    : series_(std::move(series)), file_(std::move(path), series_) {}

ProbesCsv::ProbesCsv(std::filesystem::path path, const std::vector<std::string>& columns)
    : ProbesCsv(std::move(path), empty_series(columns)) {}

ProbesCsv ProbesCsv::continued(std::filesystem::path path, const std::vector<std::string>& columns,
                               double last_time) {
  if (!std::filesystem::exists(path)) return ProbesCsv(std::move(path), columns);
  ProbeSeries before = rows_until(read_csv(path), last_time, path.string());
  const ProbeSeries expected = empty_series(columns);
  if (before.columns == expected.columns) return ProbesCsv(std::move(path), std::move(before));
  throw InputError(
      fmt::format("{}: has other columns than this scene's probes ({}); resume with the "
                  "scene of that run, or start again",
                  path.string(), fmt::join(expected.columns, ", ")));
}

void ProbesCsv::add(double time, const std::vector<double>& values) {
  std::vector<double> row{time};
  row.insert(row.end(), values.begin(), values.end());
  file_.add(row);
  series_.rows.push_back(std::move(row));
}

}  // namespace tack
