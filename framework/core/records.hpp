// The one vocabulary in which terms and steppers tell what they do: named forces, energies, flows of energy and fields. Probes,
// reactions, frames, the balance of energy, steps.csv and summaries ask for these, and know no term.
//
// Terms publish once, when the world is built (Term::publish). What is published is asked for at states that are kept (flows: of a step
// that is going to be), and nothing is computed before. A stepper whose forces are other ones than the gradients of potentials, impulses over
// the step for instance, puts them in the place of the terms' by replacing the records of the same name (Stepper::prepare).
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/core/term.hpp"
#include "geometry/types.hpp"

namespace tack {

struct ObjectPair {
  int a, b;
};

// Which probes and fields it belongs to: contact_force and pressures, friction_force, or only those that name it.
enum class Acting { normal, tangential, otherwise };

struct ForceRecord {
  std::string name;  // "contact", "rim", "bonds", "friction", ...; those of one name add up
  Acting acting = Acting::otherwise;
  // What of it can be asked for alone: probes do for "barrier" and "adhesion" of normal forces, "friction" and "adhesion" of tangential
  // ones. "" is all of it.
  std::vector<std::string> parts = {};
  // Adds those of a part on every vertex (3n) [N], held ones included. Unless given: minus the gradient of the term that publishes it.
  std::function<void(const VecX& x, std::string_view part, VecX& forces)> add = {};
  // What object b exerts on object a [N]. None: it does not act between objects.
  std::function<Vec3(const VecX& x, std::string_view part, ObjectPair pair)> between = {};
  // Of normal ones, for pressures: adds what each vertex is pressed with (positive) or pulled, whatever the direction; and what it has
  // of the area over which the force acts, if others do not tell already. In the first of three (3n) [N, m^2].
  std::function<void(const VecX& x, std::string_view part, VecX& pressed)> add_compressions = {};
  std::function<void(const VecX& x, VecX& areas)> add_areas = {};
  // It follows from an energy that is stored; else what works against it is dissipated.
  bool stored = true;
  const Term* term = nullptr;  // that published it, whose gradient it is a part of; null: reactions take it from here

  bool has(std::string_view part) const;
};

enum class EnergyKind {
  motion,           // kinetic
  of_objects,       // stored in objects
  weight,           // of gravity
  contact,          // stored between objects, over areas that are taken anew at the start of each step
  between_objects,  // stored between them otherwise
  of_step           // the potential of the last step alone, about what it dissipated: not stored
};
constexpr bool is_stored(EnergyKind kind) { return kind != EnergyKind::of_step; }

struct EnergyRecord {
  std::string name;  // its column is energy_<name>; those of one name add up
  EnergyKind kind = EnergyKind::of_objects;  // the same one for all of a term
  std::function<double(const VecX& x)> value = {};  // J
  const Term* term = nullptr;  // that published it: all that it published add up to its value
};

// An energy of a state [J].
struct NamedEnergy {
  std::string name;
  double value = 0;
  EnergyKind kind = EnergyKind::of_objects;
};

enum class FlowKind {
  fed,        // it puts energy into what is stored
  within,     // it moves energy within what is stored
  dissipated  // it takes it away
};

struct FlowColumn {
  std::string name;  // of steps.csv: work_... of what is fed or within, dissipated_...
  FlowKind kind = FlowKind::dissipated;
};

// What a step does to energy.
struct FlowRecord {
  std::string name;  // whose
  std::vector<FlowColumn> columns;  // columns of one name add up
  // Writes the amount of each for the step to x, while all that takes part still holds what it held in it [J].
  std::function<void(const VecX& x, double* amounts)> amounts = {};
  // Calls share(vertices, energy) for each stencil: what the step to x dissipates there, less what it
  // feeds [J]. None: all stencils of the term belong together (Term::share_energy).
  std::function<void(const VecX& x, const EnergyShare& share)> shares = {};
  const Term* term = nullptr;  // that published it
};

struct FieldRecord {
  std::string name;  // registered (published_field.hpp)
  // Of vertices: one or three numbers for each, as many as are in x, not a number where there is nothing. Of elements: as many as are
  // registered for each of the term's stencils, which are one batch of tets or triangles. Where several terms have one, their sum or the largest counts.
  std::function<VecX(const VecX& x)> values = {};
  bool of_elements = false;
  bool summed = false;
  const Term* term = nullptr;  // that published it
  const std::vector<Tet>* tets = nullptr;  // of elements: those, in the place of the term's stencils

  void combine(double value, double& with) const;
};

// Of each of the term's stencils, which are one batch of tets or triangles: Cauchy's, of this term alone.
struct StressRecord {
  std::function<std::vector<Mat3>(const VecX& x)> values = {};  // Pa
  const Term* term = nullptr;  // that published it
  const std::vector<Tet>* tets = nullptr;  // those, in the place of the term's stencils
};

// Tets that may be exchanged for others between steps, and what those have to take over (framework/remesh).
struct ExchangeableTets {
  std::string body;                        // whose
  const std::vector<Tet>* tets = nullptr;  // all that it has
  std::function<std::vector<double>()> volumes = {};                 // without stress [m^3]
  std::function<std::vector<Mat3>(const VecX& x)> elastic = {};      // deformations from there, of an isotropic material
  std::function<std::vector<double>()> flow = {};                    // accumulated plastic strains
  std::string flow_remembered_as;                                    // where the history has those
};

class Records {
 public:
  // Takes in what the term publishes.
  void publish(const Term& term);
  // Called by Term::publish, and by others for what is of no term. Throw std::logic_error for what no file could show: a field that is not
  // registered, a column with another prefix.
  void add(ForceRecord record);
  void add(EnergyRecord record);
  void add(FlowRecord record);
  void add(FieldRecord record);
  void add(StressRecord record);
  void add(ExchangeableTets record) { exchangeable_.push_back(std::move(record)); }

  // Puts it in the place of all of its name; what was the gradient of a term then is none, for reactions and the balance of energy. Throw
  // std::logic_error if there is none of the name.
  void replace(ForceRecord record);
  void replace(EnergyRecord record);
  void replace(FlowRecord record);
  // Takes all forces of that name away: of potentials that a stepper does not use.
  void remove_forces(const std::string& name);

  const std::vector<ForceRecord>& forces() const { return forces_; }
  const std::vector<EnergyRecord>& energies() const { return energies_; }
  const std::vector<FlowRecord>& flows() const { return flows_; }
  const std::vector<FieldRecord>& fields() const { return fields_; }
  const std::vector<StressRecord>& stresses() const { return stresses_; }
  const std::vector<ExchangeableTets>& exchangeable() const { return exchangeable_; }

  // Sums over all forces that act so (3n) [N], zero without any; those of a part, "": all.
  void add_forces(Acting acting, const VecX& x, std::string_view part, VecX& forces) const;
  bool acts(Acting acting) const;  // whether anything does
  // Whether something else acts in the place of the term.
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
