// The list of kinds has each list of candidates once, with its primitives, lengths and order.
#include "geometry/broad_phase/candidate_kinds.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "geometry/broad_phase/broad_phase.hpp"
#include "geometry/distance/squared_distance.hpp"
#include "tests/geometry/broad_phase/scenes.hpp"

using namespace tack;
using namespace tack::scenes;

TEST_CASE("kinds of candidates: each list once, in its order, with its lengths and bounds", "[broad_phase]") {
  const Scene scene = mixed(12, 60);
  BroadPhase broad_phase(scene.mesh, CollidingObjects());
  const VecX x = scene.x();
  broad_phase.update(x, VecX(), 0.08, 0.02);
  const Candidates& candidates = broad_phase.candidates();
  std::mt19937 random(7);
  const VecX y = x + random_motion(random, x.size(), 0.01);
  const DisplacementBounds bounds(scene.mesh, [&](int v) { return (vertex(y, v) - vertex(candidates.reference, v)).norm(); });
  size_t pairs = 0;
  std::set<const void*> lists;
  for_each_kind(scene.mesh, candidates, [&](const auto& kind) {
    pairs += kind.pairs.size();
    CHECK(lists.insert(&kind.pairs).second);
    CHECK(kind.pairs.size() > 0);
    REQUIRE(kind.distance_bounds.size() == kind.pairs.size());
    REQUIRE(kind.reference_distances.size() == kind.pairs.size());
    for (size_t i = 0; i < kind.pairs.size(); ++i) {
      const auto& a = kind.first(kind.pairs[i]);
      const auto& b = kind.second(kind.pairs[i]);
      const double distance = std::sqrt(squared_distance(corners(y, a), corners(y, b)));
      CHECK(distance >= kind.reference_distances[i] - kind.distance_change(bounds, kind.pairs[i]));
      if (i > 0) CHECK(kind.order_key(scene.mesh, kind.pairs[i - 1]) < kind.order_key(scene.mesh, kind.pairs[i]));
    }
  });
  CHECK(lists.size() == 4);
  CHECK(pairs == candidates.size());
}
