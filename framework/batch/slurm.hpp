// A batch as Slurm job arrays with a task for each case.
#pragma once

#include "framework/batch/batch_run.hpp"

namespace tack {

// A job array. Slurm limits the indices of tasks (MaxArraySize), so task i of the array runs case
// `offset` + i of the plan.
struct JobArray {
  std::string tasks;  // as "0-3,7"
  size_t offset = 0;
};

// Divides `cases` (ascending indices of cases in the plan) into arrays with indices below `size`.
std::vector<JobArray> job_arrays(const std::vector<size_t>& cases, size_t size);

// Returns the script for sbatch, which runs case SLURM_ARRAY_TASK_ID + (first argument, or 0) of
// the plan with `program`.
std::string job_script(const std::string& program, const BatchFolder& folder,
                       const SlurmConfig& slurm, const BatchLimits& limits);

// The submitted job arrays of a batch.
struct SlurmJobs {
  std::vector<std::string> ids;
  std::vector<ChildProcess> waiting;  // sbatch --wait: each ends together with its array
  bool unanswered = false;            // an interrupt ended sbatch before it gave a number

  bool ended();
  std::string names() const;   // "job 12", "jobs 12, 13"
  std::string cancel() const;  // the command that ends them
  // Returns "job 12 goes on (`scancel 12` ends it)".
  std::string running_text() const;
};

// Writes the script of the folder and its tasks (slurm_tasks.hpp), and submits the script for
// `cases` (ascending indices in the plan), with several arrays where there are more cases than an
// array has tasks. With `wait`, processes wait for the arrays. An interrupt request ends it between
// arrays, or before sbatch answers. Throws InputError with the message of sbatch.
SlurmJobs submit(const std::string& program, const BatchFolder& folder, const SlurmConfig& slurm,
                 const BatchDescription& batch, const std::vector<size_t>& cases, bool wait);

// Asks Slurm to queue the job of this process again. Throws InputError with the message of
// scontrol.
void requeue_this_job(const std::filesystem::path& output);

}  // namespace tack
