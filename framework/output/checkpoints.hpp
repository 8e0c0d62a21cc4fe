// The checkpoints of a run: checkpoints/step_00000120.checkpoint and so on, of which the last is gone
// on from. After each, the run starts afresh (World::forget), as a resumed one does: so both have the
// same bits.
#pragma once

#include "framework/output/run_folder.hpp"
#include "framework/output/state_file.hpp"

namespace tack {

std::filesystem::path checkpoint_path(const RunFolder& folder, int step);

// Throws InputError, with the remedy, if there is none or it is of another scene than `scene` (resolved,
// as YAML).
StateFile newest_checkpoint(const RunFolder& folder, const std::string& scene);

// When the next one is due: the first multiple of the interval after `time` [s].
double next_checkpoint(double interval, double time, double step);

}  // namespace tack
