#include "geometry/distance/slab_bounds.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "geometry/distance/squared_distance.hpp"

using namespace tack;

namespace {

// Random pairs, some of them with coordinates on a coarse lattice: parallel, touching, or of no length.
template <size_t A, size_t B>
void check_bounds() {
  std::mt19937 random(29);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 2000; ++trial) {
    const bool lattice = trial % 2 == 1;
    const double size = trial % 3 == 0 ? 1e-3 : 1;
    const auto number = [&] { return size * (lattice ? std::round(1.4 * any(random)) : any(random)); };
    std::array<std::array<Vec3, A>, pack_width> a;
    std::array<std::array<Vec3, B>, pack_width> b;
    std::array<PackVec3, A> packed_a;
    std::array<PackVec3, B> packed_b;
    const auto fill = [&](auto& one, auto& packed, int lane) {
      for (size_t i = 0; i < one.size(); ++i)
        for (int d = 0; d < 3; ++d) packed[i](d).set(lane, one[i][d] = number());
    };
    for (int l = 0; l < pack_width; ++l) fill(a[l], packed_a, l), fill(b[l], packed_b, l);
    const Pack bound = slab_bound(packed_a, packed_b);
    for (int l = 0; l < pack_width; ++l) {
      const double distance = std::sqrt(squared_distance(a[l], b[l]));
      INFO("pair " << trial << ", lane " << l << ": " << distance << " and " << bound[l]);
      REQUIRE(bound[l] >= 0);
      REQUIRE(bound[l] <= distance * (1 + 1e-12) + 1e-12 * size);
      if (!lattice) REQUIRE(bound[l] >= distance * (1 - 1e-6) - 1e-9 * size);
    }
  }
}

}  // namespace

TEST_CASE("slab bounds are equal to the distance of the primitives, and never larger", "[distance]") {
  check_bounds<1, 1>();
  check_bounds<1, 2>();
  check_bounds<1, 3>();
  check_bounds<2, 2>();
}
