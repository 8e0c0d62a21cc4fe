// Tables for a page.
#pragma once

#include <filesystem>
#include <vector>

#include "framework/output/csv.hpp"
#include "framework/report/page.hpp"

namespace tack {

// {columns, rows: their number, block, wide: columns of doubles}. Times and numbers of steps are doubles, all others floats. With more than
// `most` rows, every so manieth is kept, and the last.
nlohmann::ordered_json number_table(const CsvTable& table, PageData& page, size_t most = 20000);

// {columns, rows: [[text or number or null]]}
nlohmann::ordered_json text_table(const CsvTexts& table);

// {name, about, table, text (compare.md)} of a folder of `tack compare`.
nlohmann::ordered_json comparison_data(const std::filesystem::path& folder);

// {batch.json as it is, table (results.csv), curves: [number_table or null] of the probes of each case, units {column: unit}}.
nlohmann::ordered_json batch_data(const std::filesystem::path& folder, PageData& page);

// {calibration.json as it is, table (evaluations.csv), fits: of each experiment {fit, run}: number_table or null, notes}.
nlohmann::ordered_json calibration_data(const std::filesystem::path& folder, PageData& page);

}  // namespace tack
