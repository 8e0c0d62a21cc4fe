// A batch from its file to the cases that are still to run, all checked, and to its table.
#pragma once

#include "framework/batch/batch_description.hpp"
#include "framework/batch/batch_run.hpp"
#include "framework/batch/case_state.hpp"
#include "framework/output/provenance.hpp"

namespace tack {

struct BatchSettings {
  std::string file;                 // for the records; absolute
  std::string output;               // empty: results/<name>
  Provenance provenance;            // of this call
  int jobs = 0, threads = 0;        // 0: as the file says
  std::optional<BatchTable> table;  // none: as the file says
  std::vector<std::string> only;    // names of cases, with * and ?; empty: all
  bool rerun_failed = false;
  bool dry_run = false;  // makes no folder
};

// Called while a batch is prepared; each may be empty.
struct PreparationObserver {
  std::function<void(const std::string& line)> print;
  // "planned" or "checked", and how many cases of all are. May throw Interrupted.
  std::function<void(const char* what, size_t done, size_t all)> progress;
};

struct PreparedBatch {
  BatchDescription description;
  BatchFolder folder;                  // without a folder on disk in a dry run
  std::vector<const BatchCase*> open;  // to run; of description.plan.cases
  size_t done = 0;                     // finished by earlier calls
};

// Plans the cases, builds each case that is to run once, and opens the folder. Throws one
// InputError with the errors of all cases, or for a name of `only` that no case has; then nothing
// is written.
PreparedBatch prepare_batch(const BatchConfig& config, const BatchSettings& settings,
                            const PreparationObserver& observer);

// Returns true if the case has one of the names, or if there are none.
bool is_named(const std::vector<std::string>& names, const BatchCase& one);

// Writes the table and the description in their present state. Returns the state of each case.
std::vector<CaseState> write_batch_table(const BatchFolder& folder,
                                         const BatchDescription& description);

}  // namespace tack
