// Initial state from a run: the state of another run, by object, for a scene that starts there.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/core/history.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/scene/start_config.hpp"
#include "geometry/mesh/digest.hpp"

namespace tack {

struct World;

// The vertices of a state that belong to an object, and its mesh.
struct StateObject {
  // Vertices of its mesh in order, then those without mesh (Body::extra_vertices).
  std::vector<int> vertices;
  MeshDigest mesh;  // before mesh placement
};

// Returns every object of a world, by name, and interactions that have unknowns, which have no
// mesh.
std::map<std::string, StateObject> state_objects(const World& world);

struct InitialStateFromRun {
  std::string file;  // for messages
  double time = 0;   // s
  VecX x, v, a;      // 3n: [m], [m/s], [m/s^2]
  History history;
  std::map<std::string, StateObject> objects;
  std::vector<std::string> order;  // names of objects, by their numbers in the keys of the history
  std::map<std::string, std::string> energies;  // per object: energies_text
};

// Returns the energies of an object as text, as InitialStateFromRun::energies has them.
std::string energies_text(const ObjectConfig& object);

// Sets the objects that `start` names, or all that both have, to their state in the run: positions,
// their own history variables (arrays that begin with their name), and history between them (arrays
// with keys, core/history.hpp, of any name; interactions). Returns a line on it. Throws InputError
// for objects that neither has, that had another mesh or other vertices beyond it, or that have
// history variables and other energies now.
std::string start_from_run(const StartConfig& start, const InitialStateFromRun& earlier,
                           const SceneConfig& scene, World& world);

}  // namespace tack
