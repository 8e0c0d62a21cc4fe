// A batch as one job array of Slurm: each of its tasks is a case.
#pragma once

#include "framework/batch/batch_run.hpp"

namespace tack {

// The script for sbatch, which runs the tasks `tasks` (places in the plan) by `program`.
std::string job_script(const std::string& program, const BatchFolder& folder, const BatchConfig& config, const BatchLimits& limits,
                       const std::vector<size_t>& tasks);

struct SlurmJob {
  std::string id;
  ChildProcess waiting;  // sbatch --wait, which ends when all of the array has
};

// Submits the script of the folder. Throws InputError with what sbatch says.
SlurmJob submit(const BatchFolder& folder);
std::string submit_and_leave(const BatchFolder& folder);  // the job's number

}  // namespace tack
