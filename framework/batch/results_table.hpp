// Table of a batch, a row per case: results.csv, and results.h5 (results_hdf5.hpp). Numbers are in
// SI.
// Columns:
// - case; the varied keys; status and error
// - expect:NAME (1 or 0) and value:NAME of each expectation; the statistics of probes
// - steps, dofs, newton_iterations, linear_solves, linear_iterations, failed_solves, max_contacts,
//   min_distance, min_gap [m], intersections, inverted_tets, warnings (different ones in the
//   summary)
// - measurements that vary from run to run: wall_seconds, seconds_PHASE, process_seconds and
//   cpu_seconds (of the case's process; of a resumed case, summed over its processes), memory_mb
// A cell is empty if the case has no such number: it did not finish, or the expectation belongs to
// another experiment.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "framework/batch/batch_description.hpp"

namespace tack {

// Content of a column.
enum class ColumnRole { name, parameter, status, expectation, statistic, count, cost };
std::string_view to_string(ColumnRole role);

struct ResultsColumn {
  std::string name;
  ColumnRole role;
  // One of both, with a value per row; an empty cell is NaN or "". Parameters are texts as in the
  // batch file, numbers with a unit converted to SI.
  std::vector<double> numbers;
  std::vector<std::string> texts;

  bool is_number() const { return texts.empty(); }
  std::string cell(size_t row) const;
};

struct ResultsTable {
  size_t rows = 0;
  std::vector<ResultsColumn> columns;
};

// Returns the table from the present contents of a batch folder. states: of each case.
ResultsTable results_of(const BatchFolder& folder, const BatchPlan& plan,
                        const std::vector<CaseState>& states);

std::string csv_text(const ResultsTable& table);

// Returns true for the names of columns that every batch has.
bool is_reserved_column(const std::string& name);

}  // namespace tack
