// results.csv: a row per case of a batch. Numbers are in SI. Columns:
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
#include <vector>

#include "framework/batch/batch_description.hpp"

namespace tack {

struct ResultsTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

// Returns the table from the present contents of a batch folder.
ResultsTable results_of(const BatchFolder& folder, const BatchPlan& plan);

std::string csv_text(const ResultsTable& table);

// Returns true for the names of columns that every batch has.
bool is_reserved_column(const std::string& name);

}  // namespace tack
