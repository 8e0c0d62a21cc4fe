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

namespace tack {
namespace {

std::vector<std::string> barrier_warnings(const World& world) {
  std::vector<std::string> lines;
  for (const AdhesionSummary& a : world.adhesion)
    if (a.loss() > AdhesionSummary::tolerated_loss)
      lines.push_back(fmt::format(
          "adhesion {}: the barrier's stiffness takes {:.0f}% of the work of adhesion "
          "({:.4g} of {:.4g} J/m^2 remain); lower contact.barrier.stiffness",
          a.names(), 100 * a.loss(), a.effective, a.work_of_adhesion));
  return lines;
}

// Returns warnings of meshing, once for copies (fill.hpp).
std::vector<std::string> meshing_warnings(const World& world) {
  constexpr std::string_view prefix = "warning: ";  // geometry/meshing/notes.hpp
  std::vector<std::string> lines, printed;
  for (const Body& body : world.bodies)
    for (const std::string& note : body.notes) {
      if (!note.starts_with(prefix) || std::find(printed.begin(), printed.end(), note) != printed.end()) continue;
      printed.push_back(note);
      lines.push_back(fmt::format("object '{}': {}", body.name, note.substr(prefix.size())));
    }
  return lines;
}

}  // namespace

std::vector<std::string> scene_warnings(const Experiment& experiment, World& world) {
  const LawCheck laws = check_laws(world);
  std::vector<std::string> all;
  for (const auto& lines : {laws.errors, laws.warnings, meshing_warnings(world), barrier_warnings(world), element_warnings(experiment, world),
                            scale_warnings(experiment, world), resolution_warnings(experiment, world), round_friction_warnings(experiment, world), flush_face_warnings(experiment, world),
                            tolerance_warnings(experiment, world)})
    all.insert(all.end(), lines.begin(), lines.end());
  return all;
}

}  // namespace tack
