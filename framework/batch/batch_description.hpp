// batch.json: the description of a batch and its cases, from which `tack batch --collect` makes the
// table again.
//
// Keys:
// - name, about, file
// - provenance {...}: framework/output/provenance_json.hpp
// - threads, jobs, time_limit [s], memory [GB]
// - keys: [columns that vary]
// - units: {column: unit}
// - statistics: [{name, probe, statistic, along, where, over}]
// - table: format of the table
// - plots: as in the file
// - cases: [{name, folder, scene, values {column: text}, digest, status, error}]
#pragma once

#include "framework/batch/batch_folder.hpp"
#include "framework/batch/batch_plan.hpp"
#include "framework/batch/case_state.hpp"
#include "framework/output/provenance.hpp"

namespace tack {

// Resource limits of a batch.
struct BatchLimits {
  int threads = 1, jobs = 1;
  std::optional<double> memory;      // GB, of a case
  std::optional<double> time_limit;  // s, of a case
};

struct BatchDescription {
  BatchPlan plan;  // cases read from batch.json have no scenes
  std::string file;
  BatchLimits limits;
  std::string provenance;  // provenance_text()
  BatchTable table = BatchTable::csv;
};

// Returns the provenance as JSON, as in batch.json.
std::string provenance_text(const Provenance& provenance);

// Returns the state of a case; waiting if its digest is not that of the stored state.
CaseState state_of(const BatchFolder& folder, const BatchCase& one);

// Returns the state of each case, in order.
std::vector<CaseState> states_of(const BatchFolder& folder, const BatchPlan& plan);

// Writes batch.json with the state of each case. Throws InputError if it cannot be written.
void write_description(const BatchFolder& folder, const BatchDescription& description,
                       const std::vector<CaseState>& states);

// Returns true if the folder has a batch that this one does not continue: one with another name,
// or one of another file without a common case name.
bool is_other_batch(const BatchFolder& folder, const BatchDescription& description);

// Reads batch.json. Throws InputError if it is missing or damaged.
BatchDescription read_description(const BatchFolder& folder);

}  // namespace tack
