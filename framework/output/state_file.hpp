// The state between two steps with all data to continue from it: one file in CBOR (RFC 8949). A
// problem is the following step, to be minimised again; a checkpoint is a run to be resumed.
// Numbers are exact, so that the same program takes the same step from the file, bit for bit.
//
// Format: a line "tack state 2 crc32 CHECKSUM bytes SIZE" (format version; checksum and size of the
// rest), then a map, all in SI:
//    kind            "problem" or "checkpoint"
//    program, commit
//    scene           resolved, as YAML
//    meshes          {object: {vertices, tets, triangles, edges, points, tags}}, problems only:
//                    meshes that were read from files
//    file_meshes     {object: [vertex count, element count, checksums of vertices, elements and
//                    groups]}, checkpoints only: digests of such meshes (geometry/mesh/digest.hpp)
//    plugins         {path: CRC-32 of the file}, checkpoints only
//    files           {path: digest} read by the scene (framework/config/file_digest.hpp)
//    objects         {object: {vertices: of its mesh and others, mesh: digest}}
//    state           {time, step, h_before, acted_before, h_next, held, x, v, a,
//                    anchor, x_before, v_before, contact, contact_before,
//                    history {name: {width, values, keys}}, energy (energy_account.hpp)}
//    step_size       of a problem [s]
//    minimum         of a problem: where its potential is least (3n) [m]; absent if not known
//    minimum_tolerance  velocity tolerance to which it was found [m/s]
//    totals          {name: number}
//    linear_solver   text
//    warnings        [[text, kind, times, subject]]: this and the two before of a checkpoint's run
//                    so far
//    flowed          {object: {vertices, tets, tags, surface, shapes, volumes}} of remeshed objects
//                    (framework/body/flowed_mesh.hpp)
//    remeshings      records of a checkpoint's run
// Fields of later programs are absent from older files and then have State's defaults. The version
// rises when the meaning of existing fields changes.
#pragma once

#include <filesystem>
#include <cstdint>
#include <map>
#include <string>

#include "framework/body/flowed_mesh.hpp"
#include "framework/core/state.hpp"
#include "framework/core/warning.hpp"
#include "framework/remesh/remeshing.hpp"
#include "framework/setup/initial_state.hpp"
#include "geometry/mesh/digest.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

struct StateFile {
  enum class Kind { problem, checkpoint };
  Kind kind = Kind::problem;
  std::string program, commit;                    // of the writing program
  std::string scene;                              // YAML
  std::map<std::string, Mesh> meshes;             // by object
  std::map<std::string, MeshDigest> file_meshes;  // by object
  std::map<std::string, std::uint32_t> plugins;   // checksums of their files, by path
  // Digests of the files that the scene of a checkpoint reads, by path.
  std::map<std::string, std::string> files;
  std::map<std::string, StateObject> objects;  // by name; empty in older files
  State state;
  double step_size = 0;          // of a problem [s]
  VecX minimum;                  // of a problem (3n) [m]; empty: not known
  double minimum_tolerance = 0;  // of it [m/s]
  std::map<std::string, double> totals;
  std::string linear_solver;           // of a checkpoint's run so far: solver and reason
  std::vector<WarningCount> warnings;  // of a checkpoint's run so far
  FlowedMeshes flowed;                 // meshes of remeshed objects
  std::vector<Remeshing> remeshings;   // of a checkpoint's run so far
};

void write_state_file(const std::filesystem::path& path, const StateFile& file);

// Reads a file. Throws InputError with the file and the reason: missing, not a state file, another
// version or kind, damaged, truncated.
StateFile read_state_file(const std::filesystem::path& path, StateFile::Kind kind);

// Returns whether a file begins as a state file does; false for one that cannot be read.
bool begins_as_state_file(const std::filesystem::path& path);

// Throws InputError unless the state has that number of vertices. name: for messages.
void check_size(const StateFile& file, Eigen::Index vertices, const std::string& name);

}  // namespace tack
