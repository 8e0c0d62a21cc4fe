#include "framework/report/table_data.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/config/read_file.hpp"
#include "framework/report/packing.hpp"
#include "framework/report/scene_data.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr size_t rows_of_all_curves = 60000, fewest_rows = 50;

std::vector<size_t> kept_rows(size_t rows, size_t most) {
  std::vector<size_t> kept;
  const size_t stride = (rows + most - 1) / std::max<size_t>(1, most);
  for (size_t i = 0; i < rows; i += std::max<size_t>(1, stride)) kept.push_back(i);
  if (!kept.empty() && kept.back() + 1 < rows) kept.push_back(rows - 1);
  return kept;
}

Json cell(const std::string& text) {
  if (text.empty()) return Json();
  if (const auto number = csv_number(text)) return std::isfinite(*number) ? Json(*number) : Json();
  return Json(text);
}

// Returns the title of compare.md, from its line "# title".
std::string title_of(const std::string& markdown) {
  if (!markdown.starts_with("# ")) return "";
  return markdown.substr(2, markdown.find('\n') - 2);
}

}  // namespace

Json number_table(const CsvTable& table, PageData& page, size_t most) {
  const std::vector<size_t> rows = kept_rows(table.rows.size(), most);
  std::vector<double> wide;
  std::vector<float> narrow;
  Json columns_wide = Json::array();
  for (size_t c = 0; c < table.columns.size(); ++c) {
    const bool is_wide = table.columns[c] == "time" || table.columns[c] == "step";
    if (is_wide) columns_wide.push_back(c);
    for (const size_t r : rows) {
      if (is_wide) wide.push_back(table.rows[r][c]);
      else narrow.push_back(static_cast<float>(table.rows[r][c]));
    }
  }
  return {{"columns", table.columns}, {"rows", rows.size()}, {"of", table.rows.size()}, {"wide", columns_wide},
          {"block", page.add(planes(std::span<const double>(wide)) + planes(std::span<const float>(narrow)))}};
}

Json text_table(const CsvTexts& table) {
  Json rows = Json::array();
  for (const auto& row : table.rows) {
    Json cells = Json::array();
    for (const std::string& text : row) cells.push_back(cell(text));
    rows.push_back(std::move(cells));
  }
  return {{"columns", table.columns}, {"rows", std::move(rows)}};
}

Json comparison_data(const fs::path& folder) {
  const std::string text = fs::exists(folder / "compare.md") ? read_file(folder / "compare.md", largest_text) : "";
  return {{"name", title_of(text)}, {"table", text_table(read_csv_texts(folder / "compare.csv"))}, {"text", text}};
}

Json suite_data(const fs::path& folder) {
  Json suite = Json::parse(read_file(folder / "leaderboard.json", largest_text), nullptr, false);
  if (!suite.is_object()) throw InputError(fmt::format("{}: is not a file of `tack suite`; run the suite again", (folder / "leaderboard.json").string()));
  return {{"suite", std::move(suite)}, {"table", text_table(read_csv_texts(folder / "leaderboard.csv"))}};
}

Json calibration_data(const fs::path& folder, PageData& page) {
  Json calibration;
  try {
    calibration = Json::parse(read_file(folder / "calibration.json", largest_text));
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: is not a file of `tack calibrate` ({})", (folder / "calibration.json").string(), error.what()));
  }
  if (!calibration.is_object()) throw InputError(fmt::format("{}: is not a JSON object; calibrate again", (folder / "calibration.json").string()));
  Json notes = Json::array(), fits = Json::array(), table;
  const auto read_optional = [&](const fs::path& path, const auto& read) -> Json {
    if (!fs::is_regular_file(path)) return Json();
    try {
      return read(path);
    } catch (const InputError& error) {
      notes.push_back(error.what());
      return Json();
    }
  };
  const auto numbers = [&](const fs::path& path) { return number_table(read_csv(path), page); };
  if (const auto experiments = calibration.find("experiments"); experiments != calibration.end() && experiments->is_array())
    for (const Json& one : *experiments)
      fits.push_back({{"fit", read_optional(folder / one.value("fit", ""), numbers)}, {"run", read_optional(folder / one.value("run", ""), numbers)}});
  table = read_optional(folder / "evaluations.csv", [](const fs::path& path) { return text_table(read_csv_texts(path)); });
  if (calibration.value("status", "") != "done") notes.push_back("the calibration is unfinished; call it again to continue");
  return {{"calibration", std::move(calibration)}, {"table", std::move(table)}, {"fits", std::move(fits)}, {"notes", std::move(notes)}};
}

Json batch_data(const fs::path& folder, PageData& page) {
  Json batch;
  try {
    batch = Json::parse(read_file(folder / "batch.json", largest_text));
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: is not a file of `tack batch` ({})", (folder / "batch.json").string(), error.what()));
  }
  const auto cases = batch.find("cases");
  if (!batch.is_object() || cases == batch.end() || !cases->is_array())
    throw InputError(fmt::format("{}: has no list of cases; run the batch again", (folder / "batch.json").string()));
  Json notes = Json::array(), curves = Json::array(), units = Json::object();
  const auto read_or_note = [&](const auto& read) {
    try {
      read();
    } catch (const InputError& error) {
      notes.push_back(error.what());
    }
  };
  const size_t most = std::max(fewest_rows, rows_of_all_curves / std::max<size_t>(1, cases->size()));
  for (const Json& one : *cases) {
    const fs::path run = folder / one.value("folder", "");
    Json table;
    if (fs::exists(run / "probes.csv")) read_or_note([&] { table = number_table(read_csv(run / "probes.csv"), page, most); });
    curves.push_back(std::move(table));
    if (units.empty() && fs::exists(run / "scene.yaml")) read_or_note([&] { units = probe_units(run / "scene.yaml"); });
  }
  Json table;
  if (fs::exists(folder / "results.csv")) read_or_note([&] { table = text_table(read_csv_texts(folder / "results.csv")); });
  return {{"batch", std::move(batch)}, {"table", std::move(table)}, {"curves", std::move(curves)}, {"units", std::move(units)},
          {"notes", std::move(notes)}};
}

}  // namespace tack
