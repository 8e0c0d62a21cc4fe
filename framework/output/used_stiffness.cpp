#include "framework/output/used_stiffness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "framework/contact/contact_system.hpp"
#include "framework/world/world.hpp"

namespace tack {
namespace {

double number_of(const std::string& text) {
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

// Returns the stiffness of the barrier in a law; 0 if the law has no such key.
double barrier_stiffness(const PairLaw& law) {
  for (const auto& term : law.laws())
    if (const auto* barrier = dynamic_cast<const BarrierLaw*>(term.get())) {
      const Value value = to_value(barrier);
      if (const Value* stiffness = value.find("stiffness"); stiffness && !stiffness->is_null()) return number_of(stiffness->text);
    }
  return 0;
}

}  // namespace

UsedStiffness used_stiffness(const World& world) {
  UsedStiffness used;
  if (world.contact) {
    const PairTable& table = world.contact->pairs();
    std::map<int, size_t> of_law;
    for (const auto& [a, b] : table.classes().examples())
      for (int region_pair = -1; region_pair < table.region_pair_count(a, b); ++region_pair) {
        const int law = table.codimensional(a, b, region_pair).law;
        if (law < 0 || barrier_stiffness(table.laws()[law]) == 0) continue;
        const auto [found, is_new] = of_law.emplace(law, used.barriers.size());
        if (is_new) used.barriers.push_back({{world.bodies[a].name, world.bodies[b].name}, 0, barrier_stiffness(table.laws()[law])});
        used.barriers[found->second].pairs += table.classes().pairs_like(a, b);
      }
  }
  for (const Body& body : world.bodies) {
    if (body.frame.empty() || !body.movable) continue;
    const auto like = std::find_if(used.affine.begin(), used.affine.end(), [&](const auto& a) { return a.stiffness == body.stiffness; });
    if (like == used.affine.end()) used.affine.push_back({body.name, 1, body.stiffness});
    else ++like->objects;
  }
  return used;
}

std::vector<std::vector<std::string>> meeting_names(const World& world) {
  std::vector<std::vector<std::string>> names;
  for (const std::vector<int>& group : world.meeting.bodies) {
    names.emplace_back();
    for (const int body : group) names.back().push_back(world.bodies[body].name);
  }
  return names;
}

std::string comments_of(const UsedStiffness& used) {
  std::string text;
  for (const auto& b : used.barriers)
    text += fmt::format("#   barrier '{}' - '{}'{}: {:.6g} Pa\n", b.between[0], b.between[1], b.pairs > 1 ? fmt::format(" ({:.0f} pairs)", b.pairs) : "", b.stiffness);
  for (const auto& a : used.affine)
    text += fmt::format("#   affine body '{}'{}: {:.6g} Pa\n", a.object, a.objects > 1 ? fmt::format(" ({} objects)", a.objects) : "", a.stiffness);
  return text.empty() ? "" : "# Stiffness in this run, where the scene gives none found from what can meet:\n" + text;
}

}  // namespace tack
