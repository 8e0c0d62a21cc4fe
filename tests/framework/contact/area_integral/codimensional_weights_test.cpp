// Areas of rods and particles towards triangles: exact above surfaces of any mesh, and continuous
// everywhere.
#include "framework/contact/area_integral/codimensional_weights.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "framework/contact/terms/contact_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tet_body.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

namespace {

using Path = std::function<VecX(double)>;  // positions along a path from 0 to 1

// Returns the energy of contact, with the areas at x.
double energy(const World& world, const VecX& x) {
  world.contact->begin_step({x});
  world.contact->move_to(x);
  return contact_term(world).value(x);
}

// Returns the largest difference over a millionth of the path, relative to the largest value, by
// bisection of the intervals with the largest differences.
double largest_jump(const World& world, const Path& path, int steps) {
  struct Interval {
    double change, from, to, at_from, at_to;
  };
  std::vector<Interval> intervals;
  double largest = 0, before = energy(world, path(0));
  for (int i = 1; i <= steps; ++i) {
    const double now = energy(world, path(double(i) / steps));
    intervals.push_back({std::abs(now - before), double(i - 1) / steps, double(i) / steps, before, now});
    largest = std::max(largest, std::abs(now));
    before = now;
  }
  std::sort(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) { return a.change > b.change; });
  intervals.resize(std::min<size_t>(intervals.size(), 5));
  double jump = 0;
  for (Interval& p : intervals) {
    while (p.to - p.from > 1e-6) {
      const double middle = (p.from + p.to) / 2, value = energy(world, path(middle));
      if (std::abs(value - p.at_from) > std::abs(value - p.at_to)) p.to = middle, p.at_to = value;
      else p.from = middle, p.at_from = value;
    }
    jump = std::max(jump, std::abs(p.at_to - p.at_from));
  }
  return largest > 0 ? jump / largest : 0;
}

// A rod or a particle of width 2 mm beside a body, with adhesion of a range of 2 mm.
std::string beside_body(const std::string& body, bool rod) {
  const std::string thin = rod ? "shape: {type: segment, length: 8 mm, edges: 2}, rod: {radius: 1 mm}, "
                                 "energies: [{type: elastic_rod, young: 1e7, density: 1000}]"
                               : "shape: {type: points, size: [0, 0, 0], counts: [1, 1, 1]}, particle: {radius: 1 mm}, "
                                 "energies: [{type: particle, density: 2000}]";
  return fmt::format("objects:\n  - {{name: body, {}}}\n  - {{name: thin, {}, place: {{translate: [0.1, 0, 0]}}}}\n"
                     "contact:\n  distance: 1 mm\n  pairs: [{{between: [body, body], contact: false}}, {{between: [body, thin], adhesion: {{type: fang, peak_traction: 1000}}}}]\n",
                     body, thin);
}
std::string solid(const std::string& shape) {
  return "shape: " + shape + ", energies: [{type: neo_hookean, young: 1e5, poisson: 0.3, density: 1000}]";
}
std::string sheet(const std::string& shape) {
  return "shape: " + shape + ", shell: {thickness: 0.1 mm}, energies: [{type: stvk_membrane, young: 1e6, poisson: 0.3, density: 1000}]";
}

struct Pair {
  Pair(const std::string& body, bool rod) : scene(beside_body(body, rod)), world(*scene.world), moved(world.rest) {
    const auto& object = world.contact->surface().mesh.vertex_object;
    for (size_t v = 0; v < object.size(); ++v) (object[v] == world.body_index("body") ? body_vertices : codimensional_vertices).push_back(static_cast<int>(v));
  }
  // Returns positions with the codimensional object at a point, turned by a rotation vector.
  VecX placed(VecX x, const Vec3& at, const Vec3& turn) const {
    const Mat3 r = turn.norm() > 0 ? Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() : Mat3::Identity();
    for (const int v : codimensional_vertices) vertex(x, v) = at + r * (Vec3(vertex(world.rest, v)) - Vec3(0.1, 0, 0));
    return x;
  }

  TestScene scene;
  const World& world;
  VecX moved;
  std::vector<int> body_vertices, codimensional_vertices;
};

}  // namespace

TEST_CASE("the far side of a plate exerts no force on rods and particles, whatever its thickness and mesh", "[contact][codimensional]") {
  for (const bool rod : {false, true})
    for (const int cells : {1, 7})
      for (const double thickness : {5e-3, 1e-3, 2e-4}) {
        const Pair pair(solid(fmt::format("{{type: box, size: [0.04, {}, 0.04], cells: [{}, 1, {}]}}", thickness, cells, cells)), rod);
        const double gap = 1.2e-3, height = thickness / 2 + gap;
        const double area = rod ? 2e-3 * 8e-3 : M_PI * 1e-6;
        const PairLaw& law = pair.world.contact->pairs().laws()[pair.world.contact->pairs().codimensional(0, 1).law];
        for (const Vec3& at : {Vec3(0, height, 0), Vec3(3.1e-3, height, 2.2e-3), Vec3(-1e-3, -height, 0.3e-3)})
          CHECK(energy(pair.world, pair.placed(pair.world.rest, at, Vec3::Zero())) == Approx(area * law.at(gap).value).epsilon(1e-6));
      }
}

TEST_CASE("over the edge of a face the whole tributary area counts, whatever the rounding", "[contact][codimensional]") {
  RandomMotions random(7);
  const Pair pair(solid("{type: box, size: [0.01, 0.01, 0.01], cells: [1, 1, 1]}"), false);
  const PairLaw& law = pair.world.contact->pairs().laws()[pair.world.contact->pairs().codimensional(0, 1).law];
  const double gap = 1.2e-3;
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 turn = random.vector();
    const Mat3 r = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    VecX x = pair.world.rest;
    for (const int v : pair.body_vertices) vertex(x, v) = r * Vec3(vertex(pair.world.rest, v));
    for (const double aside : {-1e-9, 0.0, 1e-9}) {
      const Vec3 at(random.uniform(-4e-3, 4e-3), 0.005 + gap, 0.005 + aside);
      INFO(trial << " " << aside);
      CHECK(energy(pair.world, pair.placed(x, r * at, Vec3::Zero())) == Approx(M_PI * 1e-6 * law.at(gap).value).epsilon(1e-3));
    }
  }
}

namespace {

// A path around a body at the centre, at changing distances. surface: returns the nearest surface point to a point outside.
struct Passing {
  explicit Passing(RandomMotions& random)
      : from(random.vector().normalized()), to((from + 0.5 * random.vector()).normalized()), turn(random.vector()), turned(turn + random.vector()),
        gaps{random.uniform(0.4e-3, 1.9e-3), random.uniform(0.4e-3, 1.9e-3)} {}
  template <class Surface>
  VecX at(const Pair& pair, const VecX& x, double s, const Surface& surface) const {
    const Vec3 outside = 0.012 * (from + s * (to - from)).normalized(), on = surface(outside);
    const double gap = gaps[0] + s * (gaps[1] - gaps[0]);
    return pair.placed(x, on + gap * (outside - on).normalized(), turn + s * (turned - turn));
  }
  Vec3 from, to, turn, turned;
  std::array<double, 2> gaps;  // m
};

bool apart(const World& world, const Path& path, int steps) {
  for (int i = 0; i <= steps; ++i) {
    const VecX x = path(double(i) / steps);
    world.contact->begin_step({x});
    if (!(world.contact->smallest_gaps(x).between_objects > 2e-4)) return false;
  }
  return true;
}

constexpr int steps = 150;

}  // namespace

TEST_CASE("rods and particles pass over plates, edges and corners without a jump", "[contact][codimensional]") {
  RandomMotions random(3);
  struct Body {
    std::string yaml;
    Vec3 half;  // of a box
  };
  for (const bool rod : {false, true})
    for (const auto& [yaml, half] : {Body{solid("{type: box, size: [0.01, 0.003, 0.01], cells: [2, 1, 3]}"), {0.005, 0.0015, 0.005}},
                                     Body{sheet("{type: grid, size: [0.01, 0.01], cells: [3, 2]}"), {0.005, 0, 0.005}}}) {
      const Pair pair(yaml, rod);
      const auto surface = [&, &half = half](const Vec3& p) { return Vec3(p.cwiseMax(-half).cwiseMin(half)); };
      int compared = 0;
      for (int trial = 0; trial < 40; ++trial) {
        const Passing passing(random);
        const Path path = [&](double s) { return passing.at(pair, pair.world.rest, s, surface); };
        if (!apart(pair.world, path, steps)) continue;
        ++compared;
        INFO((half.y() > 0 ? "box " : "sheet ") << rod << " " << trial);
        CHECK(largest_jump(pair.world, path, steps) < 1e-3);
      }
      CHECK(compared > 5);
    }
}

TEST_CASE("surfaces that crumple beside rods and particles cause no jump of the energy", "[contact][codimensional]") {
  RandomMotions random(5);
  for (const bool rod : {false, true}) {
    const Pair pair(solid("{type: sphere, radius: 5 mm, cells: 4}"), rod);
    int compared = 0;
    for (int trial = 0; trial < 60; ++trial) {
      VecX crumpled = VecX::Zero(pair.world.rest.size());
      for (const int v : pair.body_vertices) vertex(crumpled, v) = 0.0015 * random.vector();
      const Passing passing(random);
      const Path path = [&](double s) {
        return passing.at(pair, pair.world.rest + s * crumpled, s, [](const Vec3& p) { return Vec3(0.005 * p.normalized()); });
      };
      if (!apart(pair.world, path, steps)) continue;
      ++compared;
      INFO(rod << " " << trial);
      CHECK(largest_jump(pair.world, path, steps) < 1e-3);
    }
    CHECK(compared > 5);
  }
}
