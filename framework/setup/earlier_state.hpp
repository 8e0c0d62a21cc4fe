// The state of another run, by object, for a scene that starts there.
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

// Which vertices of a state are an object's, and of what mesh.
struct StateObject {
  std::vector<int> vertices;  // of its mesh in order, then its that are in no mesh (Body::extra_vertices)
  MeshDigest mesh;            // before it was placed
};

// Of every object of a world, by name; and of interactions that have unknowns, which have no mesh.
std::map<std::string, StateObject> state_objects(const World& world);

struct EarlierState {
  std::string file;  // for messages
  double time = 0;   // s
  VecX x, v, a;      // 3n: [m], [m/s], [m/s^2]
  History history;
  std::map<std::string, StateObject> objects;
  std::vector<std::string> order;  // their names, by their numbers in the keys of the history
  std::map<std::string, std::string> energies;  // of objects: what they are, as text
};

// As EarlierState has them.
std::string energies_text(const ObjectConfig& object);

// Puts the objects of the world's start that `start` names, or all that both have, where they were, with what they remember, each
// by itself (arrays that begin with its name), and of each other (arrays with keys, core/history.hpp, of any name; interactions);
// returns a line on it. Throws InputError for objects that neither has, had another mesh or other vertices beyond it, or remember
// and have other energies now.
std::string start_as_before(const StartConfig& start, const EarlierState& earlier, const SceneConfig& scene, World& world);

}  // namespace tack
