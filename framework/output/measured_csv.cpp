#include "framework/output/measured_csv.hpp"

#include <fmt/format.h>

#include <set>

#include "framework/output/csv.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

std::string rows_of(const Expectation& e, const ProbeSeries& series, const std::vector<StageVisit>& stages) try {
  const StatisticQuery query = e.resolved();
  const MeasuredComparison f = compare_with_measured(query, series, e.windows(stages));
  std::string rows;
  for (size_t i = 0; i < f.curve.size(); ++i)
    rows += fmt::format("{},{},{},{},{},{}\n", csv_cell(query.probe), csv_cell(query.along), f.curve.x[i], f.curve.y[i], f.run[i], csv_cell(e.stage));
  return rows;
} catch (const InputError&) {
  return "";  // the expectation reports the reason
}

}  // namespace

void write_measured(const std::filesystem::path& path, const std::vector<Expectation>& expectations, const ProbeSeries& series, const std::vector<StageVisit>& stages) {
  std::string text;
  std::set<std::string> written;  // several statistics may have the same data
  for (const Expectation& e : expectations)
    if (e.query.follows)
      if (std::string rows = rows_of(e, series, stages); written.insert(rows).second) text += rows;
  if (!text.empty()) replace_file(path, "probe,along,x,measured,computed,stage\n" + text);
}

}  // namespace tack
