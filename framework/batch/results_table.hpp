// results.csv: a row per case of a batch.
//
// Columns: case; what varies, numbers in SI; status and error; expect:NAME (1 or 0) and value:NAME of each expectation; the statistics of
// probes; steps, dofs, newton_iterations, linear_solves, linear_iterations, failed_solves, max_contacts, min_distance, min_gap [m],
// intersections, inverted_tets, warnings (how many different ones its summary has); then what was measured and differs from run to run: wall_seconds, seconds_PHASE, process_seconds
// and cpu_seconds (of the case's process; of one that was gone on with, of all of its processes), memory_mb. A cell is empty where there is no such
// number: of a case that did not run to its end, of an expectation that another experiment has.
#pragma once

#include <string>
#include <vector>

#include "framework/batch/batch_description.hpp"

namespace tack {

struct ResultsTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

// From the folder of a batch as it is now.
ResultsTable results_of(const BatchFolder& folder, const BatchPlan& plan);

std::string csv_text(const ResultsTable& table);

// Whether a column of that name is there whatever a batch varies.
bool taken_column(const std::string& name);

}  // namespace tack
