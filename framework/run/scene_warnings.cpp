#include "framework/run/scene_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/checks/element_warnings.hpp"
#include "framework/checks/flush_faces.hpp"
#include "framework/checks/law_check.hpp"
#include "framework/checks/resolution.hpp"
#include "framework/checks/round_friction.hpp"
#include "framework/checks/scale_warnings.hpp"
#include "framework/experiment/tolerances.hpp"
#include "geometry/meshing/mesh_warnings.hpp"

namespace tack {
namespace {

std::vector<Warning> barrier_warnings(const World& world) {
  std::vector<Warning> warnings;
  for (const AdhesionSummary& a : world.adhesion)
    if (a.loss() > AdhesionSummary::tolerated_loss)
      warnings.emplace_back(WarningKind::adhesion_in_barrier, fmt::format(
          "adhesion {}: the barrier's stiffness takes {:.0f}% of the work of adhesion "
          "({:.4g} of {:.4g} J/m^2 remain); lower contact.barrier.stiffness",
          a.names(), 100 * a.loss(), a.effective, a.work_of_adhesion));
  return warnings;
}

// Returns warnings of meshing, once for copies (fill.hpp).
std::vector<Warning> meshing_warnings(const World& world) {
  std::vector<Warning> warnings;
  std::vector<std::string> printed;
  for (const Body& body : world.bodies)
    for (std::string note : body.notes) {
      note.erase(0, note.find_first_not_of(' '));  // notes of the steps of a processed shape are indented
      if (!note.starts_with(mesh_warning::any) || std::find(printed.begin(), printed.end(), note) != printed.end()) continue;
      printed.push_back(note);
      warnings.emplace_back(WarningKind::mesh_bound, fmt::format("object '{}': {}", body.name, note.substr(mesh_warning::any.size())));
    }
  return warnings;
}

}  // namespace

std::vector<Warning> scene_warnings(const Experiment& experiment, World& world) {
  const LawCheck laws = check_laws(world);
  std::vector<Warning> all;
  for (const auto& lines : {laws.errors, laws.warnings, meshing_warnings(world), barrier_warnings(world), element_warnings(experiment, world),
                            scale_warnings(experiment, world), resolution_warnings(experiment, world), round_friction_warnings(experiment, world), flush_face_warnings(experiment, world),
                            tolerance_warnings(experiment)})
    all.insert(all.end(), lines.begin(), lines.end());
  return all;
}

}  // namespace tack
