// Rolling by friction as unknowns of a world (contact/points/contact_spins.hpp). Rods use the
// twists of their edges (rod_twists.hpp). A particle gets three arcs at its radius of gyration,
// sqrt(2/5) of its radius, with its mass, hence the moment of inertia 2/5 m r^2. Its orientation
// has no effect, so that the arcs are the integral of the angular velocity over time.
#pragma once

#include "framework/contact/points/contact_spins.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Appends the arcs of the particles of body `index`, if they roll.
void add_spins(const ObjectConfig& object, int index, World& world);
// Gives the arcs of body `index` the masses of its particles.
void add_spin_masses(int index, World& world);
// Fixes the arcs of those particles of body `index` that are in `vertices`, unless `motion` is
// partial: only particles fixed in all directions do not rotate.
void fix_spins(const Motion& motion, const std::vector<int>& vertices, const std::string& name,
               int index, World& world);
// Sets the velocities of the arcs of body `index` for an initial angular velocity [rad/s].
void set_spin_velocities(const Vec3& angular_velocity, int index, const World& world, VecX& v);

// Returns the rolling bodies. Throws InputError for an object that cannot roll: without
// contact_offset, or with rods of non-circular section.
ContactSpins contact_spins(const SceneConfig& scene, const World& world);

}  // namespace tack
