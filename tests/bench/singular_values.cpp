// Singular value decompositions of deformation gradients: one after the other and side by side.
#include "energies/solid/svd3.hpp"

#include <random>

#include "geometry/types.hpp"
#include "tests/bench/registered.hpp"

namespace tack::bench {
namespace {

constexpr int count = 4096;

// I plus entries of up to a tenth, squeezed by a fifth along y.
std::vector<Mat3> deformations() {
  std::mt19937 generator(3);
  std::vector<Mat3> f(count);
  for (Mat3& m : f) {
    m = Mat3::Identity() + 0.1 * Mat3::NullaryExpr([&](auto...) {
          return 2.0 * generator() / double(std::mt19937::max()) - 1.0;
        });
    m.row(1) *= 0.8;
  }
  return f;
}

void svd3_single(benchmark::State& state) {
  const auto given = deformations();
  for (auto _ : state)
    for (const Mat3& f : given) benchmark::DoNotOptimize(svd3(f));
  state.SetItemsProcessed(state.iterations() * count);
}
BENCHMARK(svd3_single)->UseRealTime();

void svd3_pack(benchmark::State& state) {
  const auto given = deformations();
  for (auto _ : state) {
    for (int first = 0; first < count; first += pack_width) {
      PackMat3 f;
      for (int l = 0; l < pack_width; ++l) set_lane<3, 3>(f, l, given[first + l]);
      benchmark::DoNotOptimize(svd3(f));
    }
  }
  state.SetItemsProcessed(state.iterations() * count);
}
BENCHMARK(svd3_pack)->UseRealTime();

}  // namespace
}  // namespace tack::bench
