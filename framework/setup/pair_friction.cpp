#include "framework/setup/pair_friction.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/errors.hpp"

namespace tack {

std::optional<FrictionConfig> friction_of(const PairConfig* pair, const ContactConfig& contact, const ObjectConfig& a, const ObjectConfig& b) {
  if (pair && pair->friction) return pair->friction;
  std::optional<FrictionConfig> friction = contact.friction;
  if (!a.friction || !b.friction) return friction;
  if (!friction) friction.emplace();
  if (friction->mu_static || friction->mu_across)
    throw InputError(fmt::format("the surfaces of '{}' and '{}' have one coefficient of friction each, and contact.friction has mu_static or mu_across; take these away, or give the two "
                                 "a friction of their own in contact.pairs", a.name, b.name));
  friction->mu = blended(contact.blend, *a.friction, *b.friction);
  return friction;
}

double across_of(const FrictionConfig& friction, bool own, const ObjectConfig& a, const ObjectConfig& b) {
  if (!friction.mu_across) return 1;
  const bool self = &a == &b;
  if (a.grain && b.grain && !self)
    throw InputError(fmt::format("'{}' and '{}' both have a grain, and friction follows one; take one grain away, or mu_across for these two", a.name, b.name));
  if (a.grain || b.grain) return *friction.mu_across / friction.mu;
  if (own) throw InputError(fmt::format("mu_across is friction across the grain, and neither '{}' nor '{}' has one; give one of them `grain: [1, 0, 0]`, the direction of its surface", a.name, b.name));
  return 1;
}

void refuse_surface_friction_without_use(const SceneConfig& scene, const Value& root) {
  const auto location = [&, objects = root.find("objects")](size_t i, const char* key) {
    const Value* value = objects && i < objects->items.size() ? objects->items[i].find(key) : nullptr;
    return value ? value->mark.text() + ": " : "";
  };
  for (size_t i = 0; !scene.contact && i < scene.objects.size(); ++i)
    if (scene.objects[i].friction)
      throw InputError(fmt::format("{}object '{}' has friction, and the scene has no contact; give a section `contact`, or take the friction away", location(i, "friction"), scene.objects[i].name));
  const bool used = scene.contact && ((scene.contact->friction && scene.contact->friction->mu_across) ||
                                      std::any_of(scene.contact->pairs.begin(), scene.contact->pairs.end(), [](const PairConfig& pair) { return pair.friction && pair.friction->mu_across; }));
  if (used) return;
  for (size_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].grain)
      throw InputError(fmt::format("{}object '{}' has a grain, and no friction of the scene has mu_across; give friction mu_across, or take the grain away", location(i, "grain"),
                                   scene.objects[i].name));
}

}  // namespace tack
