// Contact potential: the instance of a contact model (contact_model.hpp) in a world. Calls:
//   refusal, safety_barrier_range, add_laws, roles   while pairs of objects are built, per pair
//   attach      once, by the ContactSystem that owns it; makes the terms
//   set_free, load_history, begin_step, set_candidates, find, commit   in the run, by the system
// A step calls begin_step once, set_candidates for new candidates within the step, and find for
// every configuration. The system has updated its candidates and its lagged surface before each of
// these calls. The system's set of active stencils is what find() writes; terms read it
// (contact_term.hpp), or lists of their own.
//
// Every default is that of a plain sum over close pairs of surfaces, with one law per pair of
// objects. A model must implement find(), and overrides what differs:
//   - rods and particles, where its stencils are of them as well: refusal()
//   - another potential: make_terms()
//   - contact points that are not those of the stencils: points()
//   - laws and ranges: add_laws(), roles()
// Errors: InputError without a source location.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/stencils/contact_set.hpp"
#include "framework/contact/terms/local_contact.hpp"
#include "framework/core/history.hpp"
#include "framework/core/term.hpp"

namespace tack {

class ContactSystem;

/// Parts of a scene's contact that a model may not support.
enum class ContactFeature {
  adhesion,             // by a traction-separation law of the gap
  tangential_adhesion,  // of such a law
  bonds,                // adhesion by bonds
  regions,              // laws of regions of objects
  integration_side,     // `integrate`, where it is not automatic
  both_sides,           // `integrate: both`
  barrier,              // a barrier that the scene chooses
  rods,                 // edges of an object that are in no triangle
  particles,            // vertices of an object that are in no edge
};

/// Integration side of a pair, as the scene gives it.
enum class IntegrationSide { automatic, finer, both, first, second };

/// Laws of two objects, prepared for their materials.
struct PreparedLaws {
  double offset = 0;                                // of the two surfaces [m]
  std::shared_ptr<const NormalLaw> barrier;         // over the contact distance
  std::shared_ptr<const NormalLaw> safety_barrier;  // over safety_barrier_range of it
  std::shared_ptr<const NormalLaw> adhesion;        // of the gap; null without
  TangentialLaw tangential;
  PairLaw barrier_and_adhesion() const;
};

/// Indices of the laws that a model has added to the pair table for two objects; -1: none.
struct PairLawIds {
  int pressure = -1;        // of what carries contact pressure
  int safety_barrier = -1;  // of edges, and of points that carry no pressure
  int codimensional = -1;   // of rods and particles
  int other = -1;           // of a table of the model's own
};

/// A pair of objects, or of regions of them.
struct PairSetup {
  int a = -1, b = -1;                // objects
  bool surfaces = false;             // both have triangles
  bool rods = false;                 // one of them has rods
  bool particles = false;            // one of them has particles
  bool region = false;               // these are laws of regions
  PairLawIds laws;                   // of the objects, or of the regions
  std::vector<PairLawIds> all_laws;  // of the objects, then of their pairs of regions
  IntegrationSide side = IntegrationSide::automatic;
  bool adheres = false;       // the objects, or regions of them
  bool overlap_only = false;  // adheres, or has regions: integrates over the overlap alone
  bool bonds = false;         // the objects, or regions of them, adhere by bonds
  bool gap_adhesion = false;  // the objects, or regions of them, adhere by a law of the gap
  double region_range = 0;    // largest range of laws of regions [m]
};

/// Roles of the primitives of two objects (pair_table.hpp).
struct PairRoles {
  PairRole first, second;  // of the points of a towards b, and of b towards a
  PairRole edge, codimensional;
};

/// A pair of primitives that acts.
struct ActivePair {
  int object, opposite;
  int law;                        // of the pair table
  double distance;                // offsets included [m]
  std::span<const int> vertices;  // global, of both primitives
};

/// A point of the overlap of two surfaces in the present step.
struct OverlapSite {
  int triangle;  // of the contact surface
  Vec3 inside;   // barycentric coordinates
  int object;    // the opposite one
  double area;   // m^2
  bool whole;    // the whole triangle overlaps
};

/// Base of contact potentials.
class ContactPotential {
 public:
  ContactPotential();
  virtual ~ContactPotential();
  ContactPotential(const ContactPotential&) = delete;
  ContactPotential& operator=(const ContactPotential&) = delete;

  // Building.

  /// Returns why the model does not support a feature between two objects ("it counts close pairs,
  /// not areas"); "" if it does. By default it supports adhesion of the gap, and surfaces alone.
  virtual std::string refusal(ContactFeature feature, const PairSetup& pair) const;
  /// Returns the range of PreparedLaws::safety_barrier, in contact distances. chosen: that of the
  /// scene, or its default. A scene that chooses another one than this returns is refused. The
  /// default is that of models whose pairs all have one law.
  virtual double safety_barrier_range(double /*chosen*/) const { return 1; }
  /// Returns true if pairs of one object that are close at rest have laws of their own, or none
  /// (rest_gaps.hpp). Otherwise they press like all others.
  virtual bool uses_rest_gaps() const { return false; }
  /// Adds the laws of two objects, or of regions of them, to the table. pair: without laws, and
  /// gap_adhesion of these laws alone. The default adds one law, barrier and adhesion, for all
  /// kinds of primitives.
  virtual PairLawIds add_laws(const PairSetup& pair, const PreparedLaws& laws, PairTable& table);
  /// Returns the roles of the primitives of two objects. Their ranges are those of the search, and
  /// do not count the offset of the surfaces. The default has
  ///   role                 law             area_factor
  ///   first, second        pressure        1
  ///   edge                 safety_barrier  1/4, of the sum of the areas of both edges
  ///   codimensional        codimensional   1
  /// with the ranges of these laws.
  virtual PairRoles roles(const PairSetup& pair, const PairTable& table);
  /// Returns a potential of the same model with the history of the objects a and b (or one object
  /// a = b) alone, which become 0 and 1: for a system of these objects.
  virtual std::unique_ptr<ContactPotential> isolated(int a, int b) const = 0;

  // In a world.

  /// Attaches the potential to its system, which must outlive it, and makes the terms.
  void attach(ContactSystem& system);
  /// Returns the terms of the potential, in the order of their calls.
  const std::vector<std::unique_ptr<Term>>& terms() const { return terms_; }

  /// Clears all caches: later steps give the bits of a potential that was just attached.
  virtual void clear_caches() {}
  /// Sets the free vertices (non-zero). Stencils without a free vertex are constant and may be left
  /// out. Empty: every candidate has a free vertex.
  virtual void set_free(std::vector<char> /*free*/) {}
  virtual void load_history(const History& /*history*/) {}
  virtual void commit(const VecX& /*x*/, History& /*history*/) const {}
  /// Begins a step at x. new_candidates: the candidates have changed since the last call.
  virtual void begin_step(const VecX& /*x*/, bool /*new_candidates*/) {}
  /// Takes new candidates within a step, or before the first one, at x.
  virtual void set_candidates(const VecX& /*x*/) {}
  /// Finds the active stencils at x.
  virtual void find(const VecX& x, ContactSet& contacts) = 0;

  /// Returns the search for active stencils where these vertices (ascending) alone move; null if
  /// the model has none, as by default. It serves a ContactTerm; a model with other dynamic terms
  /// than that and linear ones is evaluated as a whole.
  virtual std::unique_ptr<LocalContact> local(std::span<const int> moved);

  /// Returns the contact points at the system's configuration, which is that of the request:
  /// positions at which surfaces touch, adhere or slide. Friction, pressures, probes and checks
  /// read them. The default merges the active stencils of each contact point.
  virtual ContactPoints points(const ContactPointsRequest& request) const;
  /// Returns the number of pairs of primitives that act at the system's configuration.
  virtual int active_count() const;
  /// Calls visit for each of them. The default visits the active stencils.
  using ActiveVisitor = std::function<void(const ActivePair& pair)>;
  virtual void visit_active(const ActiveVisitor& visit) const;
  /// Returns the points of the overlap of pairs of objects for which wanted(a, b) is true; a: the
  /// object of the point. Bonds form there. None: the model finds no overlap.
  using PairFilter = std::function<bool(int a, int b)>;
  virtual std::vector<OverlapSite> overlap_sites(const PairFilter& /*wanted*/) const { return {}; }
  /// Keeps the integration sides of these pairs of objects (ascending) from the next step on.
  virtual void keep_sides(std::vector<std::pair<int, int>> /*pairs*/) {}

 protected:
  /// Adds the terms, once the system has its pair table; the default is the sum over the system's
  /// active stencils (ContactTerm).
  virtual void make_terms();
  void add_term(std::unique_ptr<Term> term);
  ContactSystem& system() const { return *system_; }

 private:
  ContactSystem* system_ = nullptr;
  std::vector<std::unique_ptr<Term>> terms_;
};

}  // namespace tack
