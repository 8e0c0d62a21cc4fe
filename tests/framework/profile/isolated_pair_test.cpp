// An isolated pair of objects has the stencils that it has in its world.
#include <catch2/catch.hpp>

#include "framework/profile/isolated_pair.hpp"
#include "framework/run/simulation.hpp"

using namespace tack;

TEST_CASE("pairs alone have the stencils that they have among others") {
  // With friction between many; with adhesion, guards and samples at a rim.
  const auto [file, steps] = GENERATE(table<std::string, int>({{"arch/stands", 3}, {"debonding/peel", 40}, {"first/hang", 10}}));
  CAPTURE(file);
  Simulation simulation(load_experiment(TACK_SOURCE_DIR "/experiments/" + file + ".yaml", {}));
  const World* const world = &simulation.world();
  simulation.start();
  for (int i = 0; i < steps; ++i) simulation.step();
  const auto pairs = count_pairs(*world->contact, world->friction.get());
  long stencils = 0, friction = 0;
  for (const auto& [ids, count] : pairs) {
    CAPTURE(ids.first, ids.second);
    const IsolatedPair alone = isolate(*world, ids, simulation.state());
    CHECK(alone.count.points == count.points);
    CHECK(alone.count.interior_points == count.interior_points);
    CHECK(alone.count.safety_barriers == count.safety_barriers);
    CHECK(alone.count.edges == count.edges);
    CHECK(alone.count.friction == count.friction);
    CHECK(alone.seconds.narrow_phase > 0);
    CHECK((alone.seconds.normal_stencils() > 0) == (count.stencils() > 0));
    CHECK((alone.seconds.friction_stencils() > 0) == (count.friction > 0));
    stencils += count.stencils();
    friction += count.friction;
  }
  CHECK(stencils > 0);
  CHECK(stencils == static_cast<long>(world->contact->contacts().size()));
  CHECK((friction > 0) == (world->friction != nullptr));
}
