// Records: the named forces, energies, energy flows and fields of terms and steppers. Probes,
// reactions, frames, the energy balance, steps.csv and summaries read records and know no term.
//
// Terms publish records once, when the world is built (Term::publish). Records are functions: they
// are evaluated at accepted states (flows: before a step is committed), and cost nothing otherwise.
// A stepper whose forces are not gradients of potentials (impulses over the step, for instance)
// replaces the records of the same name (Stepper::prepare).
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/core/term.hpp"
#include "geometry/types.hpp"

namespace tack {

/// Indices of two objects.
struct ObjectPair {
  int a, b;
};

/// Probes and fields that sum a force:
///   normal      contact_force and pressures
///   tangential  friction_force
///   other       only probes and fields that name it
enum class ForceDirection { normal, tangential, other };

/// A force on vertices.
struct ForceRecord {
  std::string name;  // "contact", "rim", "bonds", "friction", ...; forces of one name add up
  ForceDirection direction = ForceDirection::other;
  // Names of the summands that are available alone. Probes use "barrier" and "adhesion" of normal
  // forces, "friction" and "adhesion" of tangential forces. "" is the whole force.
  std::vector<std::string> summands = {};
  /// Adds the forces of the named summand on all vertices (3n) [N], fixed vertices included. None:
  /// minus the gradient of the term that publishes the record.
  std::function<void(const VecX& x, std::string_view summand, VecX& forces)> add = {};
  /// Returns the force of object b on object a [N]. None: the force does not act between objects.
  std::function<Vec3(const VecX& x, std::string_view summand, ObjectPair pair)> between = {};
  /// For pressures of normal forces, in the first of three entries per vertex (3n): adds the
  /// magnitude of compression (positive) or tension [N], and the area over which the force acts
  /// [m^2], unless another record adds that area.
  std::function<void(const VecX& x, std::string_view summand, VecX& compressions)>
      add_compressions = {};
  std::function<void(const VecX& x, VecX& areas)> add_areas = {};
  bool stored = true;  // true: gradient of a stored energy; false: work against it is dissipated
  // The term that publishes the record and whose gradient contains the force. Null: reactions read
  // the force from this record.
  const Term* term = nullptr;

  bool has(std::string_view summand) const;
};

/// Kinds of energies in the energy balance.
enum class EnergyKind {
  motion,           // kinetic energy
  of_objects,       // stored in objects
  weight,           // potential of gravity
  contact,          // stored between objects, over areas re-evaluated at the start of each step
  between_objects,  // stored between objects otherwise
  of_step           // potential of the last step alone, close to its dissipation: not stored
};
/// Returns true for energies that are stored.
constexpr bool is_stored(EnergyKind kind) { return kind != EnergyKind::of_step; }

/// An energy of a term.
struct EnergyRecord {
  std::string name;  // its column is energy_<name>; energies of one name add up
  EnergyKind kind = EnergyKind::of_objects;         // equal for all energies of one term
  std::function<double(const VecX& x)> value = {};  // J
  const Term* term = nullptr;  // the publishing term: its energies add up to its value
};

/// An energy of a state [J].
struct NamedEnergy {
  std::string name;
  double value = 0;
  EnergyKind kind = EnergyKind::of_objects;
};

/// Kinds of energy flows in the energy balance.
enum class FlowKind {
  fed,        // adds to the stored energy
  within,     // moves energy between stored energies
  dissipated  // removes stored energy
};

/// A column of an energy flow in steps.csv.
struct FlowColumn {
  std::string name;  // work_... (fed, within) or dissipated_...
  FlowKind kind = FlowKind::dissipated;
};

/// Energy that a step feeds, moves or dissipates.
struct FlowRecord {
  std::string name;                 // of the source
  std::vector<FlowColumn> columns;  // columns of one name add up
  /// Writes the amount of each column for the step to x [J]. Called before the step is committed,
  /// so that lagged quantities are still those of the step.
  std::function<void(const VecX& x, double* amounts)> amounts = {};
  /// Calls visit(vertices, energy) for each stencil: the dissipation of the step to x minus the fed
  /// energy [J]. None: all stencils of the term count as connected (Term::visit_energies).
  std::function<void(const VecX& x, const EnergyVisitor& visit)> visit_energies = {};
  const Term* term = nullptr;  // the publishing term
};

/// A field on vertices or elements.
struct FieldRecord {
  std::string name;  // registered (published_field.hpp)
  /// Returns the values at x:
  ///   vertices  one or three numbers per vertex; NaN where the field has no value
  ///   elements  the registered number of components per stencil of the term; the stencils are one
  ///             batch of tets or triangles
  /// Fields of one name from several terms are summed (`summed`), or the largest value counts.
  std::function<VecX(const VecX& x)> values = {};
  bool of_elements = false;
  bool summed = false;
  const Term* term = nullptr;              // the publishing term
  const std::vector<Tet>* tets = nullptr;  // elements instead of the stencils of the term

  void combine(double value, double& with) const;
};

/// Cauchy stress of one term alone, per stencil; the stencils are one batch of tets or triangles.
struct StressRecord {
  std::function<std::vector<Mat3>(const VecX& x)> values = {};  // Pa
  const Term* term = nullptr;                                   // the publishing term
  const std::vector<Tet>* tets = nullptr;  // elements instead of the stencils of the term
};

/// Tets that remeshing may exchange between steps, and the quantities to transfer
/// (framework/remesh).
struct ExchangeableTets {
  std::string body;                                              // name of the body
  const std::vector<Tet>* tets = nullptr;                        // all tets of the body
  std::function<std::vector<double>()> volumes = {};             // stress-free volumes [m^3]
  std::function<std::vector<Mat3>(const VecX& x)> elastic = {};  // elastic deformation gradients
                                                                 // of an isotropic material
  std::function<std::vector<double>()> plastic_strains = {};     // accumulated
  std::string plastic_strain_history;                            // name of their history array
};

/// All records of a world.
class Records {
 public:
  /// Adds the records of a term.
  void publish(const Term& term);
  /// Adds a record; called by Term::publish and by owners that are no terms. Throws
  /// std::logic_error for a field that is not registered and a column with another prefix.
  void add(ForceRecord record);
  void add(EnergyRecord record);
  void add(FlowRecord record);
  void add(FieldRecord record);
  void add(StressRecord record);
  void add(ExchangeableTets record) { exchangeable_.push_back(std::move(record)); }

  /// Replaces all records of its name. Reactions and the energy balance then ignore the gradient of
  /// the term that published them. Throws std::logic_error if there is no record of the name.
  void replace(ForceRecord record);
  void replace(EnergyRecord record);
  void replace(FlowRecord record);
  /// Removes all forces of a name: those of potentials that a stepper does not use.
  void remove_forces(const std::string& name);

  const std::vector<ForceRecord>& forces() const { return forces_; }
  const std::vector<EnergyRecord>& energies() const { return energies_; }
  const std::vector<FlowRecord>& flows() const { return flows_; }
  const std::vector<FieldRecord>& fields() const { return fields_; }
  const std::vector<StressRecord>& stresses() const { return stresses_; }
  const std::vector<ExchangeableTets>& exchangeable() const { return exchangeable_; }

  /// Adds all forces of a direction (3n) [N]. summand: "" for the whole forces.
  void add_forces(ForceDirection direction, const VecX& x, std::string_view summand,
                  VecX& forces) const;
  bool has_forces(ForceDirection direction) const;  // true if any force has the direction
  /// Returns true if another record replaces a record of the term.
  bool replaced(const Term& term) const;
  bool any_replaced() const { return !replaced_.empty(); }

 private:
  std::vector<ForceRecord> forces_;
  std::vector<EnergyRecord> energies_;
  std::vector<FlowRecord> flows_;
  std::vector<FieldRecord> fields_;
  std::vector<StressRecord> stresses_;
  std::vector<ExchangeableTets> exchangeable_;
  std::vector<const Term*> replaced_;
  const Term* publisher_ = nullptr;
};

}  // namespace tack
