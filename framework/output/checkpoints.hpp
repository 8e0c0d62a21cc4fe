// Checkpoints of a run: checkpoints/step_00000120.checkpoint and so on; a run resumes from the last
// one. The run starts afresh after each checkpoint (World::forget), as a resumed run does, so that
// both have the same bits.
#pragma once

#include "framework/output/run_folder.hpp"
#include "framework/output/state_file.hpp"
#include "framework/world/world.hpp"

namespace tack {

std::filesystem::path checkpoint_path(const RunFolder& folder, int step);
// Returns the path of the state of an interrupted run without checkpoints. Resuming from it does
// not give the bits of an uninterrupted run.
std::filesystem::path interrupted_path(const RunFolder& folder, int step);

// Returns the digests of the mesh files that a world was built from, by object.
std::map<std::string, MeshDigest> file_meshes_of(const World& world);

// Returns the checksums of the files of all loaded plugins, by path.
std::map<std::string, std::uint32_t> plugin_checksums();

// Returns the newest checkpoint of a folder checkpoints/; empty: none. due: without states of
// interrupted runs.
std::filesystem::path newest_checkpoint_in(const std::filesystem::path& checkpoints,
                                           bool due = false);

// Reads the newest checkpoint. scene: resolved, as YAML; files (path: digest): tables of laws and
// measured curves that the scene reads now. Throws InputError, with the differences and the remedy,
// if there is none, or its scene, meshes, plugins or files differ.
StateFile newest_checkpoint(const RunFolder& folder, const std::string& scene, const World& world,
                            const std::map<std::string, std::string>& files);

}  // namespace tack
