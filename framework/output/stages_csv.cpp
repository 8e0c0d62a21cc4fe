#include "framework/output/stages_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

constexpr const char* stages_header = "protocol,stage,number,begin,end,ended_by,value,repeated";

}  // namespace

std::vector<TimeWindow> windows_of_stage(const std::vector<StageVisit>& visits, const std::string& stage) {
  std::vector<TimeWindow> all, united;
  for (const StageVisit& v : visits)
    if (v.stage == stage && v.begin <= v.end) all.push_back({v.begin, v.end});
  std::sort(all.begin(), all.end(), [](const TimeWindow& a, const TimeWindow& b) { return a.begin < b.begin; });
  for (const TimeWindow& w : all) {
    if (!united.empty() && w.begin < united.back().end) united.back().end = std::max(united.back().end, w.end);
    else united.push_back(w);
  }
  return united;
}

void write_stages(const std::filesystem::path& path, const std::vector<StageVisit>& visits) {
  std::string text = std::string(stages_header) + "\n";
  for (const StageVisit& v : visits)
    text += fmt::format("{},{},{},{},{},{},{},{}\n", csv_cell(v.protocol), csv_cell(v.stage), v.number, v.begin, v.end, csv_cell(v.ended_by),
                        std::isnan(v.value) ? "nan" : fmt::format("{}", v.value), v.repeated);
  replace_file(path, text);
}

std::vector<StageVisit> read_stages(const std::filesystem::path& path) {
  if (std::error_code none; !std::filesystem::exists(path, none)) return {};
  std::vector<StageVisit> visits;
  for (const std::vector<std::string>& row : read_csv_texts(path).rows) {
    const auto number = [&](size_t i) { return csv_number(row[i]).value_or(std::nan("")); };
    visits.push_back({row[0], row[1], static_cast<int>(number(2)), number(3), number(4), row[5], number(6), static_cast<int>(number(7))});
  }
  return visits;
}

}  // namespace tack
