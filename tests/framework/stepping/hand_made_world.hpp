// A world made of surfaces, without a scene: for tests that need bodies and contact alone.
#pragma once

#include "framework/contact/area_integral/area_integral.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/world/world.hpp"
#include "tests/framework/contact/flat_law.hpp"
#include "tests/framework/contact/surface_builder.hpp"

namespace tack {

// Bodies named a, b, c, ... are the objects of the builder, whose vertices are consecutive. All
// pairs have contact over `range` [m], but for those that `colliding` excludes.
struct HandMadeWorld {
  HandMadeWorld(const SurfaceBuilder& builder, double range,
                const CollidingObjects& colliding = CollidingObjects()) {
    ContactSurface surface = builder.surface();
    const int objects = object_count(surface.mesh);
    world.rest = surface.rest;
    for (int object = 0; object < objects; ++object) {
      Body& body = world.bodies.emplace_back();
      body.name = std::string(1, static_cast<char>('a' + object));
      const auto& of = surface.mesh.vertex_object;
      body.first_vertex = static_cast<int>(std::find(of.begin(), of.end(), object) - of.begin());
      body.vertex_count = static_cast<int>(std::count(of.begin(), of.end(), object));
    }
    PairTable pairs(objects);
    const PairRole role{pairs.add_law(flat_law(range)), 1, range};
    for (int a = 0; a < objects; ++a)
      for (int b = 0; b < objects; ++b) {
        pairs.point(a, b) = role;
        pairs.set_edge(a, b, role);
        pairs.set_codimensional(a, b, role);
      }
    world.contact = std::make_unique<ContactSystem>(std::move(surface), std::move(pairs), colliding,
                                                    clock, std::make_unique<AreaIntegral>());
  }

  PhaseClock clock;
  World world;
};

}  // namespace tack
