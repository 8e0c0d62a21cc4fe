#include "framework/export/chains.hpp"

#include <catch2/catch.hpp>

using namespace tack;

TEST_CASE("edges become chains that end where other than two edges meet") {
  using Chains = std::vector<std::vector<int>>;
  CHECK(chains_of({{0, 1}, {1, 2}, {2, 3}}) == Chains{{0, 1, 2, 3}});
  CHECK(chains_of({{2, 1}, {0, 1}, {3, 2}}) == Chains{{0, 1, 2, 3}});           // in any order and direction
  CHECK(chains_of({{0, 1}, {1, 2}, {2, 0}}) == Chains{{0, 1, 2, 0}});           // closed
  CHECK(chains_of({{0, 1}, {1, 2}, {1, 3}}) == Chains{{0, 1}, {1, 2}, {1, 3}});  // a fork
  CHECK(chains_of({{0, 1}, {1, 2}, {2, 1}, {5, 6}}).size() == 3);                // a loop on a stalk, and another rod
  CHECK(chains_of({}).empty());
}
