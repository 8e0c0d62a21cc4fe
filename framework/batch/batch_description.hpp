// batch.json: what a batch is and was made with, and its cases, so that its table can be made again from its folder alone.
//
// Keys: name, about, file, provenance {...} (framework/output/provenance_json.hpp), threads, jobs, time_limit [s], memory [GB], keys [columns that vary], units {column: unit},
// statistics [{name, probe, statistic, along, where, over}], plots [as in the file], cases [{name, folder, scene, values {column: text}, digest, status,
// error}].
#pragma once

#include "framework/batch/batch_folder.hpp"
#include "framework/batch/batch_plan.hpp"
#include "framework/batch/case_state.hpp"
#include "framework/output/provenance.hpp"

namespace tack {

// What a batch may use.
struct BatchLimits {
  int threads = 1, jobs = 1;
  std::optional<double> memory;      // GB, of a case
  std::optional<double> time_limit;  // s, of a case
};

struct BatchDescription {
  BatchPlan plan;  // its cases without their scenes, once read
  std::string file;
  BatchLimits limits;
  std::string provenance;  // provenance_text()
};

// JSON, as it stands in batch.json.
std::string provenance_text(const Provenance& provenance);

// Waiting if what ran was another form of it.
CaseState state_of(const BatchFolder& folder, const BatchCase& one);

// With the state of each case as it is now. Throws InputError if it cannot be written.
void write_description(const BatchFolder& folder, const BatchDescription& description);

// Whether the folder holds a batch that this one does not go on with: of another name, or of another file and without a case of the same name.
bool is_other_batch(const BatchFolder& folder, const BatchDescription& description);

// Throws InputError if there is none, or it is damaged.
BatchDescription read_description(const BatchFolder& folder);

}  // namespace tack
