#include "framework/output/measured_csv.hpp"

#include <fmt/format.h>

#include <set>

#include "framework/output/csv.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

std::string rows_of(const StatisticQuery& query, const ProbeSeries& series, const TimeWindows& windows) try {
  const MeasuredComparison f = compare_with_measured(query, series, windows);
  std::string rows;
  for (size_t i = 0; i < f.curve.size(); ++i)
    rows += fmt::format("{},{},{},{},{}\n", csv_cell(query.probe), csv_cell(query.along), f.curve.x[i], f.curve.y[i], f.run[i]);
  return rows;
} catch (const InputError&) {
  return "";  // the expectation reports the reason
}

}  // namespace

void write_measured(const std::filesystem::path& path, const std::vector<Expectation>& expectations, const ProbeSeries& series, const std::vector<StageVisit>& stages) {
  std::string text;
  std::set<std::string> written;  // several statistics may have the same data
  for (const Expectation& e : expectations)
    if (const StatisticQuery query = e.resolved(); query.follows)
      if (std::string rows = rows_of(query, series, e.windows(stages)); written.insert(rows).second) text += rows;
  if (!text.empty()) replace_file(path, "probe,along,x,measured,computed\n" + text);
}

}  // namespace tack
