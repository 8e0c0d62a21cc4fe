// tasks.jsonl: what each task of a job array has to know.
//
// One line of JSON per case of the plan, in its order, with keys name, digest, threads, memory [GB]
// and time_limit [s]. Blanks fill all lines to one length, so that a task reads its own line alone:
// each of N tasks that read batch.json would read all N cases.
#pragma once

#include "framework/batch/batch_description.hpp"

namespace tack {

struct SlurmTask {
  BatchCase one;  // name and digest alone
  BatchLimits limits;
};

// Writes the file of a batch. Throws InputError if it cannot be written.
void write_tasks(const BatchFolder& folder, const std::vector<BatchCase>& cases,
                 const BatchLimits& limits);

// Reads the line of a case. number: index of the case in the plan. Throws InputError if the file is
// missing or damaged, or if the plan has no such case.
SlurmTask read_task(const BatchFolder& folder, int number);

}  // namespace tack
