// The checkpoints of a run: checkpoints/step_00000120.checkpoint and so on, of which the last is gone
// on from. After each, the run starts afresh (World::forget), as a resumed one does: so both have the
// same bits.
#pragma once

#include "framework/output/run_folder.hpp"
#include "framework/output/state_file.hpp"
#include "framework/world/world.hpp"

namespace tack {

std::filesystem::path checkpoint_path(const RunFolder& folder, int step);
// The same of a run that was interrupted and would have none: what goes on from there is not bit by bit what would have come.
std::filesystem::path interrupted_path(const RunFolder& folder, int step);

// The digests of the mesh files that a world was built from, by object.
std::map<std::string, MeshDigest> file_meshes_of(const World& world);

// Of the files of all plugins that are loaded, by path.
std::map<std::string, std::uint32_t> plugin_checksums();

// Of a folder checkpoints/; empty: there is none. `due`: without those of interrupted runs.
std::filesystem::path newest_checkpoint_in(const std::filesystem::path& checkpoints, bool due = false);

// Throws InputError, with the remedy, if there is none, or it is of another scene than `scene` (resolved,
// as YAML), of other meshes or plugins than those that are loaded, or of other `files` (path:
// digest) than the scene reads now: tables of laws, measured curves. The message names what
// differs.
StateFile newest_checkpoint(const RunFolder& folder, const std::string& scene, const World& world,
                            const std::map<std::string, std::string>& files);

}  // namespace tack
