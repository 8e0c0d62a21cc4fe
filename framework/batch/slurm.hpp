// A batch as one Slurm job array with a task for each case.
#pragma once

#include "framework/batch/batch_run.hpp"

namespace tack {

// Returns the script for sbatch, which runs the tasks `tasks` (indices of cases in the plan) with
// `program`.
std::string job_script(const std::string& program, const BatchFolder& folder,
                       const BatchConfig& config, const BatchLimits& limits,
                       const std::vector<size_t>& tasks);

struct SlurmJob {
  std::string id;
  ChildProcess waiting;  // sbatch --wait: ends together with the array
};

// Submits the script of the folder. Throws InputError with the message of sbatch.
SlurmJob submit(const BatchFolder& folder);
// Returns the job's number.
std::string submit_without_waiting(const BatchFolder& folder);

}  // namespace tack
