// Kinds of warnings. Tests, summary.json and Python tell warnings apart by kind, not by text.
#pragma once

#include <array>
#include <optional>
#include <string_view>

// Entries: key, whether the kind recurs from step to step, meaning. docs/results.md lists the same
// keys and meanings.
// clang-format off
#define TACK_WARNING_KINDS(entry)                                                                  \
  /* keys of the scene */                                                                          \
  entry(retired_key, false, "a key of the scene has been renamed; its former name is still read")  \
  /* laws, before a run */                                                                         \
  entry(law_not_finite, false, "values or derivatives of a law are not finite within its range")   \
  entry(law_derivatives, false, "derivatives of a law are not those of its energy")                \
  entry(law_dissipation, false, "a bond law dissipates more or less energy than a step takes")     \
  entry(law_traction_jump, false, "the traction of a law does not fall to 0 at its range")         \
  entry(law_energy_jump, false, "the energy of a law does not fall to 0 at its range")             \
  entry(law_statement, false, "a law has another peak traction or work than it states")            \
  entry(law_peak_in_barrier, false, "the barrier acts at the peak traction of an adhesion law")    \
  entry(law_data, false, "a table of a law is noisy, or knots do not follow its expression")       \
  entry(adhesion_in_barrier, false, "the barrier takes much of the work of adhesion")              \
  /* meshes and objects, before a run */                                                           \
  entry(mesh_bound, false, "a mesh operation missed a bound that the scene asks for")              \
  entry(volume_locking, false, "linear tets lock in volume at their Poisson's ratio")              \
  entry(coarse_rod, false, "a curved rod has few edges for a full turn")                           \
  entry(large_object, false, "an object is very large for the contact distance")                   \
  entry(heavy_object, false, "the weight of an object exceeds its stiffness")                      \
  entry(process_zone, false, "elements are larger than the process zone of their adhesion")        \
  entry(bending_length, false, "elements do not resolve the bending where a sheet peels")          \
  entry(coarse_curvature, false, "a curved surface is coarse for the range of its adhesion")       \
  entry(contact_distance, false, "the contact distance exceeds the size of elements")              \
  entry(self_contact_range, false, "the range of contact of an object with itself exceeds it")     \
  entry(self_contact_force, false, "an object starts with contact forces on itself")               \
  entry(squeezed_object, false, "an object starts squeezed within the contact distance")           \
  entry(thrown_object, false, "an object starts so close to another that it is thrown off")        \
  entry(flush_faces, false, "equal faces lie flush on each other without friction")                \
  entry(sliding_round_bodies, false, "round rods or particles with friction do not roll")          \
  entry(solver_tolerance, false, "the solver's tolerance is large for the contact distance")       \
  entry(sticking_speed, false, "a sticking speed is below the solver's tolerance")                 \
  entry(free_rotation, false, "nothing keeps a body of a quasi-static run from turning")           \
  /* steps */                                                                                      \
  entry(step_cutback, true, "a step was rolled back, and is repeated with smaller ones")           \
  entry(tolerated_step, true, "a step with a fault was accepted at the smallest step size")        \
  entry(stepper_fault, true, "a stepper accepted a fault of its own, such as crossed surfaces")    \
  entry(step_error, true, "the error of a step exceeds time.adaptive.error at the smallest size")  \
  entry(energy_growth, true, "energy grew during the run without a cause")                         \
  entry(affine_strain, true, "an affine body is strained too much")                                \
  entry(joint_play, true, "a joint gives way (counted per joint)")                                 \
  entry(no_bonds, false, "no bonds were made between two objects")                                 \
  entry(friction_impulse, true, "friction acted with another impulse than the normal force")       \
  entry(lagged_friction, true, "lag iterations of friction did not converge")                      \
  entry(not_remeshed, true, "poor elements of an object could not be replaced by good ones")       \
  entry(probe_not_finite, false, "a probe has a value that is not finite")                         \
  entry(problem_not_stored, false, "a step whose problem is to be stored was not reached")         \
  /* at the end of a run */                                                                        \
  entry(gradient_not_converged, false, "derivatives of gradients.csv were not found")              \
  entry(gradient_jump, false, "events without a derivative are left out of gradients.csv")         \
  entry(indefinite_hessian, false, "Hessians of gradients.csv were not positive definite")         \
  entry(energy_areas, false, "contact areas gained or lost energy")                                \
  entry(energy_repeats, false, "repeated steps gained or lost energy")                             \
  entry(energy_integration, false, "time integration gained or lost energy")                       \
  entry(energy_further_groups, false, "further groups of objects gained or lost energy")           \
  entry(flattened_elements, false, "plastic flow made elements flat or long")                      \
  entry(bending_locking, false, "a slender body of few tets across bends")                         \
  entry(coarse_adhesion, false, "adhesion acted on elements that are too large for it")            \
  entry(soft_barrier, false, "the barrier took much of the approach of curved bodies")             \
  /* calibrations */                                                                               \
  entry(undetermined_value, false, "the data do not determine a fitted number")                    \
  entry(value_at_bound, false, "a fitted number ended at a bound")                                 \
  entry(model_misfit, false, "the best fit misses the data by more than their noise")              \
  entry(no_intervals, false, "there are no confidence intervals")                                  \
  entry(few_points, false, "there are too few points to estimate their noise")                     \
  entry(missed_points, false, "the best run does not reach all measured points")                   \
  entry(failed_points, false, "points of the search failed")                                       \
  /* others */                                                                                     \
  entry(unspecified, false, "a checkpoint has the warning under a kind that is unknown")
// clang-format on

namespace tack {

#define TACK_WARNING_KIND(key, recurs, meaning) key,
enum class WarningKind { TACK_WARNING_KINDS(TACK_WARNING_KIND) };
#undef TACK_WARNING_KIND

/// Documentation of one kind.
struct WarningKindEntry {
  WarningKind kind;
  std::string_view key;
  bool recurs;  ///< records keep the first warning per subject and count the others
  std::string_view meaning;
};

#define TACK_WARNING_KIND(key, recurs, meaning) \
  WarningKindEntry{WarningKind::key, #key, recurs, meaning},
/// All kinds, in the order of WarningKind.
inline constexpr auto warning_kinds =
    std::to_array<WarningKindEntry>({TACK_WARNING_KINDS(TACK_WARNING_KIND)});
#undef TACK_WARNING_KIND

/// Returns the entry of a kind.
constexpr const WarningKindEntry& entry_of(WarningKind kind) {
  return warning_kinds[static_cast<std::size_t>(kind)];
}

/// Returns the kind with a key; nothing if there is none.
constexpr std::optional<WarningKind> warning_kind_of(std::string_view key) {
  for (const WarningKindEntry& e : warning_kinds)
    if (e.key == key) return e.kind;
  return std::nullopt;
}

}  // namespace tack
