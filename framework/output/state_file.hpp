// The state between two steps with all that is needed to go on from it: one file in CBOR (RFC 8949).
// A problem is the step that follows, to be minimised again; a checkpoint, a run to be resumed. The
// numbers are exact, so from such a file the same program takes the same step, bit for bit.
//
// A line "tack state 2 crc32 CHECKSUM bytes SIZE" (the version of the format; checksum and size of what
// follows), then a map: kind ("problem", "checkpoint"), program, commit, scene (resolved,
// as YAML), meshes {object: {vertices, tets, triangles, edges, points, tags}} of the objects whose meshes
// were read from files (not in checkpoints), file_meshes {object: digest of such a mesh (geometry/mesh/digest.hpp):
// [vertex count, element count, checksums of vertices, elements and groups]} and plugins {path:
// CRC-32 of the file} of a checkpoint, files {path: digest (framework/config/file_digest.hpp)} that
// its scene reads, objects {object: {vertices: those of the state that are its mesh's and its
// others', mesh: digest}}, state {time, step, whole_steps, h_before, acted_before, h_next, held, x,
// v, a, anchor, x_before, v_before, contact, contact_before, history {name: {width, values, keys}},
// energy (energy_account.hpp)}, step_size of a problem [s], totals {name: number} and linear_solver
// of a checkpoint's run so far and warnings [[text, kind, times]] of it, flowed {object: {vertices,
// tets, tags, surface, shapes, volumes}} of objects that were meshed anew
// (framework/body/flowed_mesh.hpp) and remeshings, what a checkpoint's run has told of that. All in
// SI. A field that a later program adds is absent from older files, and is then what a State holds
// by default; the version rises when what is there changes its meaning.
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
  std::string program, commit;         // what wrote it
  std::string scene;                   // YAML
  std::map<std::string, Mesh> meshes;  // by object
  std::map<std::string, MeshDigest> file_meshes;  // by object
  std::map<std::string, std::uint32_t> plugins;   // checksums of their files, by path
  // Digests of the files that the scene of a checkpoint reads, by path.
  std::map<std::string, std::string> files;
  std::map<std::string, StateObject> objects;     // by name; empty in older files
  State state;
  double step_size = 0;  // of a problem [s]
  std::map<std::string, double> totals;
  std::string linear_solver;           // of a checkpoint's run so far: what it was and why
  std::vector<WarningCount> warnings;  // of a checkpoint's run so far
  FlowedMeshes flowed;                 // of objects that were meshed anew
  std::vector<Remeshing> remeshings;   // of a checkpoint's run so far
};

void write_state_file(const std::filesystem::path& path, const StateFile& file);

// Throws InputError naming the file and what is wrong: not there, not such a file, another version or
// kind, damaged, cut short.
StateFile read_state_file(const std::filesystem::path& path, StateFile::Kind kind);

// Throws InputError unless the state is one of a scene with so many vertices.
void check_size(const StateFile& file, Eigen::Index vertices, const std::string& name);

}  // namespace tack
