// Cuts of a step and bounds per block, against the bound of the whole step and exact checks.
#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <random>

#include "framework/contact/contact_system.hpp"
#include "geometry/exact/intersections.hpp"
#include "geometry/exact/orientation.hpp"
#include "tests/support/step_problem.hpp"

using namespace tack;

namespace {

// Two soft cubes, one above the other; the upper one comes down on a corner.
const std::string soft =
    "time: {step: 10 ms}\n"
    "objects:\n"
    "  - {name: floor, shape: {type: grid, size: [0.5, 0.5], cells: [3, 3]}, motion: [fixed]}\n"
    "  - {name: lower, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}, place: {translate: [0, 0.052, 0]},\n"
    "     energies: [{type: neo_hookean, young: 1e5, density: 1000}]}\n"
    "  - {name: upper, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}, place: {axis: [1, 0.3, 2], angle: 0.4,\n"
    "     translate: [0.02, 0.185, 0.01]}, energies: [{type: neo_hookean, young: 1e5, density: 1000}]}\n"
    "contact: {distance: 1 mm}\n";
// The same with an affine cube above.
const std::string affine =
    "time: {step: 10 ms}\n"
    "objects:\n"
    "  - {name: lower, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}, place: {translate: [0, 0.052, 0]},\n"
    "     energies: [{type: neo_hookean, young: 1e5, density: 1000}]}\n"
    "  - {name: upper, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {axis: [1, 0.3, 2], angle: 0.4,\n"
    "     translate: [0.02, 0.185, 0.01]}, body: {type: affine, density: 1000}}\n"
    "contact: {distance: 1 mm}\n";

// A step down with scatter [m].
VecX motion(const StepProblem& s, double scatter, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> number(0, scatter);
  VecX p(s.q.size());
  for (Eigen::Index b = 0; b < p.size() / 3; ++b) p.segment<3>(3 * b) = Vec3(number(random), number(random) - 0.02, number(random));
  return p;
}

bool feasible(const StepProblem& s, const VecX& q) {
  const VecX x = s.configuration(q);
  return first_inverted_tet(s.world->tets, x) < 0 &&
         find_intersections(s.world->contact->surface().mesh, x, s.world->contact->colliding(), 1).empty();
}

}  // namespace

TEST_CASE("the tightest cut is the bound of the whole step, and every cut is tight by itself", "[cuts]") {
  for (const std::string& scene : {soft, affine}) {
    StepProblem s(scene);
    for (const unsigned seed : {1u, 2u, 3u}) {
      const VecX p = motion(s, 0.02, seed);
      const double whole = s.steps.largest_requested(s.potential, s.q, p);
      REQUIRE(whole < 1);
      const StepCuts all = s.steps.cuts(s.potential, s.q, p, 1), few = s.steps.cuts(s.potential, s.q, p, 2 * whole);
      REQUIRE(all.cuts.size() > few.cuts.size());
      CHECK(std::is_sorted(all.cuts.begin(), all.cuts.end()));
      double tightest = 1;
      for (size_t i = 0; i < all.cuts.size(); ++i) {
        tightest = std::min(tightest, all.cuts[i].step);
        REQUIRE(all.cuts[i].step < 1);
        for (const int block : all.blocks_of(static_cast<int>(i))) REQUIRE(block < s.world->dofs.block_count());
        REQUIRE(all.blocks_of(static_cast<int>(i)).size() > 0);
        CHECK(all.cuts[i].bodies[0] >= 0);
      }
      CHECK(tightest == Approx(whole).epsilon(1e-6));  // additive CCD depends a little on its limit
      for (const StepCut& cut : few.cuts) {
        CHECK(cut.step < 2 * whole);
        CHECK(std::binary_search(all.cuts.begin(), all.cuts.end(), cut));
      }
    }
  }
}

TEST_CASE("cuts are the same for any number of threads", "[cuts]") {
  const auto cuts = [](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
    StepProblem s(soft);
    return s.steps.cuts(s.potential, s.q, motion(s, 0.02, 1), 1);
  };
  const StepCuts one = cuts(1), four = cuts(4);
  REQUIRE(one.cuts.size() == four.cuts.size());
  CHECK(one.blocks == four.blocks);
  for (size_t i = 0; i < one.cuts.size(); ++i) {
    CHECK(one.cuts[i].vertices == four.cuts[i].vertices);
    CHECK(one.cuts[i].step == four.cuts[i].step);
  }
}

TEST_CASE("any step within the bounds of blocks is feasible", "[cuts]") {
  for (const std::string& scene : {soft, affine}) {
    StepProblem s(scene);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> fraction(0, 1);
    for (const unsigned seed : {1u, 2u}) {
      const VecX p = motion(s, 0.015, seed);
      const VecX together = s.steps.block_bounds(s.potential, s.q, p, BlockBound::together);
      const VecX alone = s.steps.block_bounds(s.potential, s.q, p, BlockBound::alone);
      REQUIRE(together.size() == s.world->dofs.block_count());
      CHECK(together.minCoeff() > 0);
      CHECK(together.maxCoeff() <= 1);
      CHECK(together.maxCoeff() > together.minCoeff());  // each block has its own; the drawn motion may cut all
      CHECK(together.minCoeff() < 1);
      // One fraction for all blocks is a step within bounds of which the tightest is that fraction.
      CHECK(together.minCoeff() <= s.steps.largest_requested(s.potential, s.q, p) * 1.03);  // additive CCD stops a little short
      for (int trial = 0; trial < 30; ++trial) {
        const MotionUnits units = s.steps.units(s.world->dofs);
        std::vector<double> of_unit(units.count);
        for (double& f : of_unit) f = trial == 0 ? 1 : fraction(random) < 0.5 ? 1 : fraction(random);
        VecX q = s.q;
        for (Eigen::Index b = 0; b < together.size(); ++b)
          q.segment<3>(3 * b) += together(b) * of_unit[units.of_vertex[s.world->dofs.vertex_of_block(static_cast<int>(b))]] * p.segment<3>(3 * b);
        REQUIRE(feasible(s, q));
      }
      if (!s.world->dofs.plain()) continue;
      for (Eigen::Index b = 0; b < alone.size(); b += 7) {
        VecX own = VecX::Zero(p.size());
        own.segment<3>(3 * b) = p.segment<3>(3 * b);
        CHECK(alone(b) == Approx(s.steps.largest_requested(s.potential, s.q, own)).epsilon(1e-6));
        CHECK(feasible(s, s.q + alone(b) * own));
        CHECK(together(b) <= alone(b) * 1.03);
      }
    }
  }
}
