// A scene ready to simulate: all vertices in one configuration, terms and unknowns.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/body/body.hpp"
#include "framework/contact/laws/adhesion_summary.hpp"
#include "framework/core/dof_map.hpp"
#include "framework/core/records.hpp"
#include "framework/core/state.hpp"
#include "framework/core/step_metric.hpp"
#include "framework/motion/motion.hpp"
#include "framework/motion/prescribed_motion.hpp"
#include "framework/protocol/drives.hpp"
#include "framework/world/acting_interaction.hpp"
#include "framework/world/multi_point_constraints.hpp"
#include "framework/world/load_terms.hpp"
#include "framework/world/meeting_groups.hpp"
#include "framework/world/unknowns.hpp"

namespace tack {

class BondTerm;
class ContactSystem;
class DampingTerm;
class FollowingLoad;
class FrictionTerm;
class OrthogonalityTerm;
class RemeshedEnergy;
class VolumeTerm;

/// A scene ready to simulate. build_world.hpp makes it.
struct World {
  World();
  ~World();

  std::vector<Body> bodies;
  VecX rest;  ///< 3n [m]: mesh vertices of the bodies, then vertices without mesh
  std::vector<int> extra_object;       ///< per vertex without mesh: its body; -1: none
  std::vector<UnknownGroup> unknowns;  ///< requests of the vertices without mesh, ascending
  VecX mass;                           ///< n [kg]
  VecX gravitational_mass;             ///< n [kg]; 0 for scalar dofs
  /// Motions beside those of the scene: relative motions in space, motions of prescribed unknowns.
  std::vector<std::unique_ptr<Motion>> own_motions;
  PrescribedMotion prescribed_motion;  ///< motion of vertices by time
  Drives drives;                       ///< of protocols; motions, loads and laws point to them
  MultiPointConstraints constraints;   ///< dependent vertices
  /// Pairs of bodies without contact, because one is attached or joined to the other, ascending.
  std::vector<std::pair<int, int>> attached;
  MeetingGroups meeting;  ///< groups of bodies that may touch each other in the run
  DofMap dofs;            ///< of the present step; before the first step, of the first one
  std::vector<Tet> tets;  ///< of all movable bodies
  Vec3 gravity = Vec3::Zero();

  std::vector<std::unique_ptr<Term>> elastic_terms;
  std::vector<ActingInteraction> interactions;  ///< in the order of the scene
  const OrthogonalityTerm* affine = nullptr;    ///< among elastic_terms; null without affine bodies
  std::vector<std::unique_ptr<DampingTerm>> damping_terms;
  GravityTerm gravity_term;
  LoadTerm load_term;
  std::vector<std::unique_ptr<FollowingLoad>> load_terms;
  std::vector<FollowingLoad*> following_loads;  ///< of all terms
  /// Fluid cavities and surface pressures among following_loads.
  std::vector<const VolumeTerm*> cavities;
  std::unique_ptr<ContactSystem> contact;    ///< null without contact
  std::unique_ptr<BondTerm> bonds;           ///< null if no pair adheres by bonds
  std::unique_ptr<FrictionTerm> friction;    ///< null without tangential forces
  std::vector<const Term*> terms;            ///< all terms above that the scene uses
  std::unique_ptr<RemeshedEnergy> remeshed;  ///< null unless objects may be remeshed
  StepParticipants participants;             ///< contact and the terms
  Records records;  ///< published by the terms, or by a stepper in place of them
  std::vector<AdhesionSummary> adhesion;
  /// Step metrics that the stepper reports of the last step.
  std::vector<StepMetric> step_metrics;
  State start;
  /// Moved objects (adjust_overclosures.hpp) and objects with an initial state from a run
  /// (initial_state.hpp).
  std::vector<std::string> start_notes;

  /// Returns the terms of contact in the order of their calls: those of the contact model, then
  /// bonds and friction.
  std::vector<Term*> contact_terms() const;

  int body_index(const std::string& name) const;  ///< -1 if there is none
  /// Returns the index of a body. Throws InputError with the nearest name, after `who` ("probe
  /// 'gap': "), if there is none.
  int index_of(const std::string& name, const std::string& who = "") const;
  int body_of(int vertex) const;  ///< body of a global vertex; -1: an interaction
  /// Returns the centre of mass at x (3n) [m]; without mass, the mean of the vertices.
  Vec3 centre_of_mass(int body, const VecX& x) const;
  std::vector<int> vertices_of(int body) const;  ///< of its mesh, then those without mesh
  /// Returns the index of a global vertex in vertices_of its body.
  int index_in_body(int vertex) const;
  bool is_scalar_dof(int vertex) const;  ///< not a position (unknowns.hpp)
  /// Moves forces (3n) on vertices of refined contact surfaces to the mesh vertices that these
  /// depend on.
  void collect_on_meshes(VecX& forces) const;
  int mesh_vertex_count() const {
    return static_cast<int>(rest.size()) / 3 - static_cast<int>(extra_object.size());
  }
  SelectionContext selection_context(int body) const { return {bodies[body], rest}; }
};

}  // namespace tack
