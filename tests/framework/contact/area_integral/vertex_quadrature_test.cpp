// Quadrature points of a list of candidates: their areas are a partition of unity, and each acts on
// the triangles of its patch that may come within range.
#include "framework/contact/area_integral/vertex_quadrature.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/framework/contact/flat_law.hpp"
#include "tests/framework/contact/surface_builder.hpp"

using namespace tack;

namespace {

constexpr double range = 0.5, barrier_range = 0.2;  // m
constexpr int whole_law = 0, barrier_law = 1;

PairRole pressure_role() { return {whole_law, 1, range, true, barrier_law, barrier_range}; }

// Objects of a builder, with all candidates of points and triangles of different objects.
struct Points {
  explicit Points(const SurfaceBuilder& builder, double bound = 0) : at(builder) {
    pairs.add_law(flat_law(range));
    pairs.add_law(flat_law(barrier_range));
    const CollisionMesh& mesh = at.surface.mesh;
    for (const int v : mesh.vertices)
      for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
        if (mesh.vertex_object[v] != mesh.vertex_object[mesh.triangles[t][0]]) candidates.point_triangle.push_back({v, t});
    candidates.distance_bounds.point_triangle.assign(candidates.point_triangle.size(), bound);
    candidates.groups.make(candidates, mesh);
  }
  VertexQuadrature make(const VertexQuadrature* earlier = nullptr, const ChangedPrimitives* changed = nullptr) {
    const IntegrationSides sides(pairs, rules);
    const RodOverlaps rods(at.surface, pairs);
    PatchFinder finder(at.surface.mesh, at.lagged);
    patches.clear();
    for (const PointGroup& g : candidates.groups.all)
      patches.push_back({g.point, g.object, finder.find(finder.at_vertex(g.point), g.triangle_end - g.triangle_begin,
                                                      [&](int i) { return candidates.point_triangle[g.triangle_begin + i][1]; })});
    std::vector<int> patches_of_group(patches.size());
    std::iota(patches_of_group.begin(), patches_of_group.end(), 0);
    const VertexQuadratureRequest request{at.surface, pairs, rules, at.lagged, sides, rods, candidates, patches, patches_of_group, {}};
    VertexQuadrature all;
    if (!earlier) {
      make_vertex_quadrature(request, nullptr, all);
      return all;
    }
    const EarlierVertexQuadrature before{*earlier, *changed};
    make_vertex_quadrature(request, &before, all);
    return all;
  }

  SurfaceAt at;
  // Lets points of a press on the surface of b.
  void press(int a, int b, bool by_size = false) {
    pairs.point(a, b) = pressure_role();
    if (by_size) pairs.point(a, b).area_factor = 0.5;
    rules.of(a, b).carries_pressure = true;
    rules.of(a, b).by_size = by_size;
  }

  PairTable pairs{2};
  IntegrationRules rules{pairs.classes()};
  Candidates candidates;
  std::vector<GroupPatches> patches;
};

// The unit square twice: object 0 faces down on object 1.
SurfaceBuilder plates(std::array<int, 2> upper, std::array<int, 2> lower, double gap = 0.1) {
  SurfaceBuilder builder;
  builder.add_rectangle(upper, 0, {0, 0, gap}, 1, 1, false);
  builder.add_rectangle(lower, 1, {0, 0, 0}, 1, 1);
  return builder;
}

double area(const Points& points, const VertexQuadrature& quadrature, int law, int object) {
  double sum = 0;
  for (const VertexQuadraturePoint& p : quadrature.points)
    if (p.law == law && points.at.surface.mesh.vertex_object[p.point] == object) sum += p.area;
  return sum;
}

}  // namespace

TEST_CASE("points of the secondary side carry the area of the surface, on all opposite triangles", "[contact][quadrature]") {
  Points points(plates({3, 4}, {2, 2}));
  points.press(0, 1);
  const VertexQuadrature quadrature = points.make();
  CHECK(quadrature.points.size() == 20);
  CHECK(area(points, quadrature, whole_law, 0) == Approx(1));
  for (const VertexQuadraturePoint& p : quadrature.points) {
    CHECK(p.law == whole_law);
    CHECK(p.range == range);
    CHECK(p.area == Approx(points.at.lagged.tributary_area(p.point)));
    CHECK(p.weight_begin == -1);
    REQUIRE(p.triangle_end - p.triangle_begin == 8);
    for (int i = p.triangle_begin; i < p.triangle_end; ++i) CHECK(points.candidates.point_triangle[quadrature.triangles[i]][0] == p.point);
  }
}

TEST_CASE("weights by size are a partition of unity: both sides together carry the area once", "[contact][quadrature]") {
  for (const auto& [upper, lower] : {std::pair(3, 3), std::pair(3, 4), std::pair(2, 9)}) {
    Points points(plates({upper, upper}, {lower, lower}));
    points.press(0, 1, true);
    points.press(1, 0, true);
    const VertexQuadrature quadrature = points.make();
    const double first = area(points, quadrature, whole_law, 0), second = area(points, quadrature, whole_law, 1), ratio = std::pow(double(lower) / upper, 8);
    CHECK(first + second == Approx(1));
    CHECK(first == Approx(1 / (1 + ratio)));  // the areas of cells enter in the fourth power
    // The safety barrier acts with the remaining weight.
    CHECK(first + area(points, quadrature, barrier_law, 0) == Approx(1));
    CHECK(second + area(points, quadrature, barrier_law, 1) == Approx(1));
  }
}

TEST_CASE("the side that is not integrated has the safety barrier on its whole area", "[contact][quadrature]") {
  Points points(plates({3, 3}, {2, 2}));
  points.press(0, 1);
  points.pairs.point(1, 0) = {barrier_law, 1, barrier_range};
  const VertexQuadrature quadrature = points.make();
  CHECK(area(points, quadrature, barrier_law, 1) == Approx(1));
  CHECK(area(points, quadrature, whole_law, 1) == 0);
  CHECK(area(points, quadrature, whole_law, 0) == Approx(1));
}

TEST_CASE("a quadrature point acts on the triangles of its patch, the safety barrier on the others", "[contact][quadrature]") {
  // A vertex above the top of a box, near its edge: it faces the top, not the sides.
  SurfaceBuilder builder;
  builder.add_rectangle({1, 1}, 0, {0.4, 0.4, 0.1}, 0.2, 0.2, false);
  builder.add_box({0, 0, -1}, {1, 1, 0}, 1);
  Points points(builder);
  points.press(0, 1);
  const VertexQuadrature quadrature = points.make();
  REQUIRE(quadrature.points.size() == 8);
  const auto faces_up = [&](int candidate) { return points.at.lagged.normal(points.candidates.point_triangle[candidate][1]).z() > 0.5; };
  for (const VertexQuadraturePoint& p : quadrature.points) {
    CHECK(p.triangle_end - p.triangle_begin == (p.law == whole_law ? 2 : 10));
    for (int i = p.triangle_begin; i < p.triangle_end; ++i) CHECK(faces_up(quadrature.triangles[i]) == (p.law == whole_law));
  }
}

TEST_CASE("quadrature points leave out triangles that stay out of range", "[contact][quadrature]") {
  RandomPoints random(1);
  Points points(plates({3, 3}, {4, 4}));
  for (double& bound : points.candidates.distance_bounds.point_triangle) bound = random.uniform(0, 1);
  points.press(0, 1);
  points.pairs.point(1, 0) = {barrier_law, 1, barrier_range};
  const VertexQuadrature quadrature = points.make();
  std::vector<int> found(points.candidates.point_triangle.size(), 0);
  for (const VertexQuadraturePoint& p : quadrature.points)
    for (int i = p.triangle_begin; i < p.triangle_end; ++i) ++found[quadrature.triangles[i]];
  for (size_t i = 0; i < found.size(); ++i) {
    const bool upper = points.at.surface.mesh.vertex_object[points.candidates.point_triangle[i][0]] == 0;
    CHECK(found[i] == (points.candidates.distance_bounds.point_triangle[i] < (upper ? range : barrier_range)));
  }
}

TEST_CASE("pairs without a law have no quadrature points", "[contact][quadrature]") {
  Points points(plates({3, 3}, {2, 2}));
  const VertexQuadrature quadrature = points.make();
  CHECK(quadrature.points.empty());
  CHECK(quadrature.group_begin.size() == points.candidates.groups.all.size() + 1);
}

TEST_CASE("quadrature points of groups follow each other in the order of the groups", "[contact][quadrature]") {
  // More groups than a chunk, so that chunks are joined.
  Points points(plates({20, 20}, {2, 2}));
  points.press(0, 1);
  points.pairs.point(1, 0) = {barrier_law, 1, barrier_range};
  const VertexQuadrature quadrature = points.make();
  REQUIRE(quadrature.group_begin.size() == points.candidates.groups.all.size() + 1);
  CHECK(quadrature.group_begin.front() == 0);
  CHECK(quadrature.group_begin.back() == static_cast<int>(quadrature.points.size()));
  for (size_t g = 0; g < points.candidates.groups.all.size(); ++g) {
    const PointGroup& group = points.candidates.groups.all[g];
    CHECK(quadrature.group_begin[g + 1] == quadrature.group_begin[g] + 1);
    for (int k = quadrature.group_begin[g]; k < quadrature.group_begin[g + 1]; ++k) {
      const VertexQuadraturePoint& p = quadrature.points[k];
      CHECK(p.point == group.point);
      for (int i = p.triangle_begin; i < p.triangle_end; ++i) {
        CHECK(quadrature.triangles[i] >= group.triangle_begin);
        CHECK(quadrature.triangles[i] < group.triangle_end);
      }
    }
  }
}

TEST_CASE("joined quadrature points are those of the chunks, one after another", "[contact][quadrature]") {
  RandomPoints random(2);
  std::vector<VertexQuadrature> chunks(6);
  for (VertexQuadrature& c : chunks)
    for (int g = random.index(6); g > 0; --g) {
      c.group_begin.push_back(static_cast<int>(c.points.size()));
      for (int k = random.index(4); k > 0; --k) {
        VertexQuadraturePoint p{};
        p.point = random.index(100);
        const auto fill = [&](auto& list, int& begin, int& end) {
          begin = static_cast<int>(list.size());
          for (int i = random.index(4); i > 0; --i) list.push_back(random.index(1000));
          end = static_cast<int>(list.size());
        };
        fill(c.triangles, p.triangle_begin, p.triangle_end);
        fill(c.edges, p.edge_begin, p.edge_end);
        fill(c.others, p.other_begin, p.other_end);
        p.weight_begin = random.index(2) ? -1 : static_cast<int>(c.weights.size());
        if (p.weight_begin >= 0)
          for (int i = p.triangle_begin; i < p.triangle_end; ++i) c.weights.push_back({random.uniform(0, 1), Vec3::UnitX(), Vec3::Zero(), false, 0.1});
        c.points.push_back(p);
      }
    }
  VertexQuadrature all;
  join({chunks.rbegin(), chunks.rend()}, all);
  all.points.emplace_back();  // what is left of other points does not matter
  join(chunks, all);
  size_t point = 0, group = 0;
  for (const VertexQuadrature& c : chunks) {
    const size_t first = point;
    for (const VertexQuadraturePoint& p : c.points) {
      const VertexQuadraturePoint& q = all.points[point++];
      CHECK(q.point == p.point);
      const auto equal = [](const std::vector<int>& a, int a0, int a1, const std::vector<int>& b, int b0, int b1) {
        return std::vector<int>(a.begin() + a0, a.begin() + a1) == std::vector<int>(b.begin() + b0, b.begin() + b1);
      };
      CHECK(equal(c.triangles, p.triangle_begin, p.triangle_end, all.triangles, q.triangle_begin, q.triangle_end));
      CHECK(equal(c.edges, p.edge_begin, p.edge_end, all.edges, q.edge_begin, q.edge_end));
      CHECK(equal(c.others, p.other_begin, p.other_end, all.others, q.other_begin, q.other_end));
      REQUIRE((q.weight_begin >= 0) == (p.weight_begin >= 0));
      if (p.weight_begin >= 0)
        for (int i = 0; i < p.triangle_end - p.triangle_begin; ++i) CHECK(all.weights[q.weight_begin + i].weight == c.weights[p.weight_begin + i].weight);
    }
    for (const int begin : c.group_begin) CHECK(all.group_begin[group++] == begin + static_cast<int>(first));
  }
  CHECK(all.points.size() == point);
  CHECK(all.group_begin.size() == group + 1);
  CHECK(all.group_begin.back() == static_cast<int>(point));
}

TEST_CASE("quadrature points that are taken over from an earlier list are those of a list from scratch", "[contact][quadrature]") {
  Points points(plates({5, 5}, {3, 3}));
  points.press(0, 1);
  points.pairs.point(1, 0) = {barrier_law, 1, barrier_range};
  const VertexQuadrature first = points.make();
  ChangedPrimitives changed;
  changed.vertices.assign(points.at.surface.mesh.vertex_object.size(), 0);
  changed.objects.assign(2, 0);
  changed.vertices[3] = 1;
  points.candidates.groups.make(points.candidates, points.at.surface.mesh);  // the same again
  const VertexQuadrature second = points.make(&first, &changed);
  REQUIRE(second.points.size() == first.points.size());
  CHECK(second.group_begin == first.group_begin);
  CHECK(second.triangles == first.triangles);
  for (size_t i = 0; i < first.points.size(); ++i) {
    CHECK(second.points[i].area == first.points[i].area);
    CHECK(second.points[i].triangle_begin == first.points[i].triangle_begin);
  }
}
