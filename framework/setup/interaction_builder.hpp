// Services for an interaction while a world is built: after all objects with masses and motions
// exist, and before unknowns are numbered. Errors are InputErrors; the caller adds the source
// location.
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

/// Builder of one interaction.
class InteractionBuilder {
 public:
  InteractionBuilder(const SceneConfig& scene, World& world, std::string name, std::string type);

  /// Name in the scene; else the type and its number in the list, "spring 0".
  const std::string& name() const { return acting_.name; }
  /// The world so far. rest: 3n [m]; mass: n [kg]; prescribed_motion: motion of vertices. Terms
  /// get the time in begin_step (step_participant.hpp).
  const World& world() const { return world_; }
  const VecX& rest() const { return world_.rest; }
  const VecX& mass() const { return world_.mass; }

  int body(const std::string& object) const;  ///< index of a body
  /// Bodies of an object, a group or "*", ascending.
  std::vector<int> bodies(const std::string& name) const;
  std::vector<int> vertices(const ObjectVertices& of) const;  ///< global, ascending, at least one
  /// Adds a vertex at position `at` [m] that moves with a body (embedding.hpp), and returns its
  /// index.
  int attachment_point(int body, const Vec3& at);

  /// Adds a fixed vertex at position `at` [m], for attachments to space, and returns its index.
  int fixed_vertex(const Vec3& at);

  /// Unknowns of the interaction.
  Unknowns unknowns() { return Unknowns(world_, acting_.name); }
  /// Makes vertices dependent from time `from` until `until` [s]. No motion may prescribe them.
  void make_dependent(Dependences dependences, double from = 0,
                      double until = std::numeric_limits<double>::infinity());
  /// Adds a joint: relations that hold exactly and throughout (joint_relations.hpp). Sets its
  /// name. At least one of its bodies must be affine and free to move.
  void add(Joint joint);
  /// Excludes contact between the two bodies, for the whole run.
  void exclude_contact(int body, int other);

  /// Adds a term that takes part in every step of the run.
  template <class T>
  T& add(std::unique_ptr<T> term) {
    T& added = *term;
    add_term(std::move(term));
    return added;
  }
  /// Declares an array of the history that one of its terms keeps, and returns its name. `start:`
  /// copies declared arrays.
  std::string add_history(const std::string& what, int width, int entries);

  ActingInteraction finish();

 private:
  void add_term(std::unique_ptr<Term> term);

  const SceneConfig& scene_;
  World& world_;
  ActingInteraction acting_;
};

/// Returns the name of entry i of the list.
std::string interaction_name(const SceneConfig& scene, size_t i);

/// Adds all interactions of the scene. root: the parsed file.
void add_interactions(const SceneConfig& scene, const Value& root, World& world);

}  // namespace tack
