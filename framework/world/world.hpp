// A scene ready to simulate: all vertices in one configuration, terms and unknowns.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/body/body.hpp"
#include "framework/contact/adhesion_summary.hpp"
#include "framework/core/dof_map.hpp"
#include "framework/core/records.hpp"
#include "framework/core/state.hpp"
#include "framework/core/step_figure.hpp"
#include "framework/motion/motion.hpp"
#include "framework/motion/script.hpp"
#include "framework/world/acting_interaction.hpp"
#include "framework/world/multi_point_constraints.hpp"
#include "framework/world/load_terms.hpp"
#include "framework/world/meeting_groups.hpp"
#include "framework/world/unknowns.hpp"

namespace tack {

class BondTerm;
class ContactSystem;
class ContactTerm;
class DampingTerm;
class FollowingLoad;
class FrictionTerm;
class OrthogonalityTerm;
class RemeshedEnergy;
class OverlapBoundaryTerm;
class VolumeTerm;

/// A scene ready to simulate. build_world.hpp makes it.
struct World {
  World();
  ~World();

  std::vector<Body> bodies;
  VecX rest;              // 3n [m]: the vertices of the bodies' meshes, then those that are in none
  std::vector<int> extra_object;  // of the latter: the body that each belongs to; -1: none
  std::vector<UnknownGroup> unknowns;  // the latter, as they were asked for, ascending
  VecX mass;              // n [kg]
  VecX gravitational_mass;     // n [kg]: what gravity pulls at; none of numbers
  std::vector<std::unique_ptr<Motion>> own_motions;  // beside those of the scene: of what is carried, and of what is held of unknowns
  Script script;          // who is held when
  MultiPointConstraints bindings;      // which vertices follow others
  std::vector<std::pair<int, int>> attached;  // bodies that are in no contact, as one is attached or joined to the other, ascending
  MeetingGroups meeting;  // bodies that may touch each other in the run
  DofMap dofs;            // of the present step; the first before it
  std::vector<Tet> tets;  // of all bodies that may move
  Vec3 gravity = Vec3::Zero();

  std::vector<std::unique_ptr<Term>> elastic_terms;
  std::vector<ActingInteraction> interactions;  ///< in the order of the scene
  const OrthogonalityTerm* affine = nullptr;  ///< among elastic_terms; null without affine bodies
  std::vector<std::unique_ptr<DampingTerm>> damping_terms;
  GravityTerm gravity_term;
  LoadTerm load_term;
  std::vector<std::unique_ptr<FollowingLoad>> load_terms;
  std::vector<FollowingLoad*> following_loads;  ///< of all terms
  /// Among following_loads: loads by an enclosed volume or a surface.
  std::vector<const VolumeTerm*> chambers;
  std::unique_ptr<ContactSystem> contact;  ///< null without contact
  std::unique_ptr<ContactTerm> contact_term;
  std::unique_ptr<OverlapBoundaryTerm> rim;            // null if no pair adheres by a law of the gap over covered areas
  std::unique_ptr<BondTerm> bonds;         // null if no pair adheres by bonds
  std::unique_ptr<FrictionTerm> friction;  // null if nothing acts along surfaces
  std::vector<const Term*> terms;  // all of the above that the scene names
  std::unique_ptr<RemeshedEnergy> remeshed;  // null if nothing may be meshed anew
  StepParticipants participants;  // contact and the terms
  Records records;                // what the terms publish, and a stepper instead of them
  std::vector<AdhesionSummary> adhesion;
  /// step metrics that the stepper reports of the last step
  std::vector<StepFigure> step_figures;
  State start;
  std::vector<std::string> start_notes;  // what was pushed apart (push_out.hpp), and who starts as before (initial_state.hpp)

  int body_index(const std::string& name) const;  ///< -1 if there is none
  /// Returns the index of a body. Throws InputError with the nearest name, after `who` ("probe
  /// 'gap': "), if there is none.
  int index_of(const std::string& name, const std::string& who = "") const;
  int body_of(int vertex) const;                  ///< body of a global vertex; -1: an interaction
  /// Returns the centre of mass at x (3n) [m]; without mass, the mean of the vertices.
  Vec3 centre_of_mass(int body, const VecX& x) const;
  std::vector<int> vertices_of(int body) const;  ///< of its mesh, then those without mesh
  /// Returns the index of a global vertex in vertices_of its body.
  int number_in_body(int vertex) const;
  bool is_number(int vertex) const;  ///< scalar dof, not a position (unknowns.hpp)
  /// Moves forces (3n) on vertices of refined contact surfaces to the mesh vertices that these
  /// depend on.
  void collect_on_meshes(VecX& forces) const;
  int mesh_vertex_count() const {
    return static_cast<int>(rest.size()) / 3 - static_cast<int>(extra_object.size());
  }
  SelectionContext selection_context(int body) const { return {bodies[body], rest}; }
};

}  // namespace tack
