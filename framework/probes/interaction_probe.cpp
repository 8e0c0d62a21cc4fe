#include "framework/probes/interaction_probe.hpp"

#include <fmt/format.h>

#include "framework/config/nearest.hpp"
#include "geometry/errors.hpp"

namespace tack {

const ActingInteraction& interaction_named(const World& world, const std::string& name, const std::string& probe) {
  std::vector<std::string> names;
  for (const ActingInteraction& interaction : world.interactions) {
    if (interaction.name == name) return interaction;
    names.push_back(interaction.name);
  }
  throw InputError(fmt::format("probe '{}': no interaction is named '{}'{}", probe, name, suggestion(name, names, "interactions")));
}

void refuse_interaction_type(const ActingInteraction& interaction, const std::string& probe, std::string_view type) {
  throw InputError(fmt::format("probe '{}': the interaction '{}' is of type {}, which {} is not a probe of", probe, interaction.name, interaction.type, type));
}

}  // namespace tack
