// Falling force residuals continue a minimisation; stagnating residuals without motion end it.
#include "solvers/minimizers/stagnation.hpp"

#include <catch2/catch.hpp>

using namespace tack;

namespace {

// Returns after how many of at most 100 iterations stagnation is found; 0: never. norm: of each step; factor: by which the residual falls in each.
int given_up(double norm, double factor) {
  Stagnation crawl;
  double residual = 1e4;
  for (int i = 1; i <= 100; ++i, residual *= factor)
    if (crawl.stagnates(norm, residual)) return i;
  return 0;
}

}  // namespace

TEST_CASE("falling force residuals continue the minimisation", "[minimizers][crawl]") {
  CHECK(given_up(1e-6, 0.5) == 0);
  CHECK(given_up(1e-6, 0.9) == 0);  // to 0.48 within the window
  CHECK(given_up(0.5, 1.0) == 0);   // motion by a tolerance is no stagnation
}

TEST_CASE("pins the window of stagnation: forces that do not halve within 8 small steps are given up", "[minimizers][crawl]") {
  CHECK(given_up(1e-3, 1.0) == 8);
  CHECK(given_up(1e-3, 0.95) == 8);
  CHECK(given_up(0.12, 1.1) == 8);
}

TEST_CASE("pins the window of stagnation: a step above the tolerance begins it again", "[minimizers][crawl]") {
  Stagnation crawl;
  for (int i = 0; i < 7; ++i) CHECK_FALSE(crawl.stagnates(1e-3, 10));
  crawl.begin();
  for (int i = 0; i < 7; ++i) CHECK_FALSE(crawl.stagnates(1e-3, 10));
  CHECK(crawl.stagnates(1e-3, 10));
}
