// Distances and additive CCD of single pairs: random edges and triangles of size 1, about 1 apart.
#include "geometry/ccd/accd.hpp"
#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "tests/bench/registered.hpp"
#include "tests/bench/scenes.hpp"

namespace tack::bench {
namespace {

constexpr int count = 1024;

struct Stencils {
  std::vector<std::array<Vec3, 4>> at, motion;

  // The vertices first.. of each stencil belong to the second primitive: lifted by 1.
  explicit Stencils(int first) {
    const VecX x = random_motion(4 * count, 0.5), p = random_motion(8 * count, 1.0);
    for (int s = 0; s < count; ++s) {
      auto& a = at.emplace_back();
      auto& m = motion.emplace_back();
      for (int i = 0; i < 4; ++i) {
        a[i] = vertex(x, 4 * s + i) + (i < first ? Vec3::Zero().eval() : Vec3::UnitY().eval());
        m[i] = vertex(p, 4 * (count + s) + i);
      }
    }
  }
};

template <class Kernel>
void measure(benchmark::State& state, int first, const Kernel& kernel) {
  const Stencils stencils(first);
  for (auto _ : state)
    for (int s = 0; s < count; ++s) benchmark::DoNotOptimize(kernel(stencils.at[s], stencils.motion[s]));
  state.SetItemsProcessed(state.iterations() * count);
}

using Corners = std::array<Vec3, 4>;

void point_triangle(benchmark::State& state) {
  measure(state, 1, [](const Corners& c, const Corners&) {
    return point_triangle_distance(c[0], c[1], c[2], c[3]);
  });
}
void point_triangle_hessian(benchmark::State& state) {
  measure(state, 1, [](const Corners& c, const Corners&) {
    return point_triangle_derivatives(c[0], c[1], c[2], c[3]);
  });
}
void edge_edge(benchmark::State& state) {
  measure(state, 2, [](const Corners& c, const Corners&) {
    return edge_edge_distance(c[0], c[1], c[2], c[3]);
  });
}
void edge_edge_hessian(benchmark::State& state) {
  measure(state, 2, [](const Corners& c, const Corners&) {
    return edge_edge_derivatives(c[0], c[1], c[2], c[3]);
  });
}
void point_triangle_ccd(benchmark::State& state) {
  measure(state, 1, [](const Corners& c, const Corners& d) {
    return point_triangle_accd(c[0], c[1], c[2], c[3], d[0], d[1], d[2], d[3], 0.1, 1.0);
  });
}
void edge_edge_ccd(benchmark::State& state) {
  measure(state, 2, [](const Corners& c, const Corners& d) {
    return edge_edge_accd(c[0], c[1], c[2], c[3], d[0], d[1], d[2], d[3], 0.1, 1.0);
  });
}
BENCHMARK(point_triangle);
BENCHMARK(point_triangle_hessian);
BENCHMARK(edge_edge);
BENCHMARK(edge_edge_hessian);
BENCHMARK(point_triangle_ccd);
BENCHMARK(edge_edge_ccd);

}  // namespace
}  // namespace tack::bench
