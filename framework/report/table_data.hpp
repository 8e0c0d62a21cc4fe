// Page data of tables.
#pragma once

#include <filesystem>
#include <vector>

#include "framework/output/csv.hpp"
#include "framework/report/page.hpp"

namespace tack {

// Returns {columns, rows: number of rows, block, wide: columns of doubles}. Times and step numbers
// are doubles, other columns floats. Of more than `most` rows, every k-th and the last are kept.
nlohmann::ordered_json number_table(const CsvTable& table, PageData& page, size_t most = 20000);

// Returns {columns, rows: [[text or number or null]]}.
nlohmann::ordered_json text_table(const CsvTexts& table);

// Returns {name, about, table, text (compare.md)} of a folder of `tack compare`.
nlohmann::ordered_json comparison_data(const std::filesystem::path& folder);

// Returns {suite (leaderboard.json), table (leaderboard.csv)} of a folder of `tack suite`.
nlohmann::ordered_json suite_data(const std::filesystem::path& folder);

// Returns {batch.json, table (results.csv), curves: per case number_table of its probes or null,
// units {column: unit}}.
nlohmann::ordered_json batch_data(const std::filesystem::path& folder, PageData& page);

// Returns {calibration.json, table (evaluations.csv), fits: per experiment {fit, run}: number_table
// or null, notes}.
nlohmann::ordered_json calibration_data(const std::filesystem::path& folder, PageData& page);

}  // namespace tack
