#include "framework/setup/add_loads.hpp"

#include <fmt/format.h>

#include "framework/load/volume_term.hpp"
#include "framework/setup/build_world.hpp"
#include "geometry/errors.hpp"

namespace tack {

void register_following_load(FollowingLoad& load, World& world) {
  if (const auto* chamber = dynamic_cast<const VolumeTerm*>(&load)) {
    for (const VolumeTerm* other : world.cavities)
      if (other->label() == chamber->label())
        throw InputError(fmt::format("two pressures or chambers are named '{}'; give one of them another name", chamber->label()));
    world.cavities.push_back(chamber);
  }
  world.following_loads.push_back(&load);
}

void add_loads(const SceneConfig& scene, const Value& root, World& world) {
  VecX force = VecX::Zero(world.rest.size());
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    const Value* object = entry_of(root.find("objects"), i);
    for (size_t j = 0; j < scene.objects[i].loads.size(); ++j)
      with_source_location(object ? entry_of(object->find("loads"), j) : nullptr, [&] {
        const Load& load = *scene.objects[i].loads[j];
        if (auto term = load.make_term(world.bodies[i], world.rest, world.mass)) {
          register_following_load(*term, world);
          world.load_terms.push_back(std::move(term));
          return;
        }
        load.add_forces(world.bodies[i], world.rest, world.mass, 0, force);
        const std::string drive = load.drive();
        world.load_term.add(load, world.bodies[i], world.rest, world.mass,
                            drive.empty() ? nullptr : &world.drives.follow(drive, FollowerKind::load, fmt::format("load {} of '{}'", j, world.bodies[i].name)));
      });
  }
}

}  // namespace tack
