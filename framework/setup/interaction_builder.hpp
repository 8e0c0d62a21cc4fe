// What an interaction is given, and may ask for, while a world is built: after all objects with their masses and motions are there, and
// before unknowns are numbered. Errors are InputErrors that name what is wrong; the place in the file is added.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/core/term.hpp"
#include "framework/scene/interaction.hpp"
#include "framework/world/acting_interaction.hpp"
#include "framework/world/unknowns.hpp"
#include "framework/world/world.hpp"

namespace tack {

struct SceneConfig;

class InteractionBuilder {
 public:
  InteractionBuilder(const SceneConfig& scene, World& world, std::string name, std::string type);

  // As the scene names it; else its type and its number in the list, "spring 0".
  const std::string& name() const { return acting_.name; }
  // The world so far. rest: 3n [m]; mass: n [kg]; script: who is held when. Terms learn the time in begin_step (step_participant.hpp).
  const World& world() const { return world_; }
  const VecX& rest() const { return world_.rest; }
  const VecX& mass() const { return world_.mass; }

  int body(const std::string& object) const;                 // its index
  std::vector<int> bodies(const std::string& name) const;    // of an object, a group, or "*"; ascending
  std::vector<int> vertices(const ObjectVertices& of) const;  // global, ascending, at least one
  // A vertex at that place [m] that a body carries along (embedding.hpp).
  int anchor(int body, const Vec3& at);

  // A vertex that stays at that place [m]: what is held to space holds on to one.
  int fixed(const Vec3& at);

  // Unknowns that belong to it.
  Unknowns unknowns() { return Unknowns(world_, acting_.name); }
  // Vertices that follow others while it lasts [s]: None may be held by a motion.
  void tie(Dependences dependences, double from = 0, double until = std::numeric_limits<double>::infinity());
  // Relations that hold exactly and throughout (joint_relations.hpp); its name is set. At least one of its bodies is affine and may move.
  void add(Joint joint);
  // There is no contact between the two, then or later.
  void join(int body, int other);

  // Takes part in every step of the run.
  template <class T>
  T& add(std::unique_ptr<T> term) {
    T& added = *term;
    take(std::move(term));
    return added;
  }
  // States an array of the history that a term of it keeps, and returns its name. What is stated goes along with `start:`.
  std::string remembers(const std::string& what, int width, int entries);

  ActingInteraction finish();

 private:
  void take(std::unique_ptr<Term> term);

  const SceneConfig& scene_;
  World& world_;
  ActingInteraction acting_;
};

// The name of an entry of the list.
std::string interaction_name(const SceneConfig& scene, size_t i);

// All of the scene. `root`: the parsed file.
void add_interactions(const SceneConfig& scene, const Value& root, World& world);

}  // namespace tack
