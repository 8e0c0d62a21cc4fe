// Friction of a pair of objects: its own, one blended from the coefficients of both surfaces, or
// the common one of the scene, in this order.
#pragma once

#include <optional>

#include "framework/scene/scene_config.hpp"

namespace tack {

// Returns the friction of two objects; none if there is none. pair: their entry, or null. Throws
// InputError, without its location, for settings that exclude each other.
std::optional<FrictionConfig> friction_of(const PairConfig* pair, const ContactConfig& contact,
                                          const ObjectConfig& a, const ObjectConfig& b);

// Returns friction across the grain over that along it. Throws InputError, without its location,
// unless one of the objects, and only one, has a grain. own: the friction is that of their pair.
double across_of(const FrictionConfig& friction, bool own, const ObjectConfig& a,
                 const ObjectConfig& b);

// Throws InputError at the grain of an object if no friction of the scene differs across it, and at
// its friction if the scene has no contact.
void refuse_surface_friction_without_use(const SceneConfig& scene, const Value& root);

}  // namespace tack
