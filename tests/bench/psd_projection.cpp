// Projection of stencil Hessians: definite ones, which an early test leaves alone, and indefinite ones.
#include "framework/assembly/psd_projection.hpp"

#include <random>

#include "tests/bench/registered.hpp"

namespace tack::bench {
namespace {

constexpr int count = 256;

// Translation-invariant symmetric matrices D^T B D, B random (definite: B^T B).
template <int K>
std::vector<Eigen::Matrix<double, 3 * K, 3 * K>> stencil_hessians(bool definite) {
  constexpr int n = 3 * K, m = 3 * (K - 1);
  using Reduced = Eigen::Matrix<double, m, m>;
  Eigen::Matrix<double, m, n> difference = Eigen::Matrix<double, m, n>::Zero();
  for (int i = 0; i < m; ++i) difference(i, i) = -1, difference(i, i + 3) = 1;
  std::mt19937 generator(7);
  std::vector<Eigen::Matrix<double, n, n>> out;
  for (int k = 0; k < count; ++k) {
    const Reduced b = Reduced::NullaryExpr([&](auto...) {
      return 2.0 * generator() / double(std::mt19937::max()) - 1.0;
    });
    const Reduced core = definite ? Reduced(b.transpose() * b) : Reduced(b + b.transpose());
    out.push_back(difference.transpose() * core * difference);
  }
  return out;
}

template <int K>
void psd_projection(benchmark::State& state) {
  const auto given = stencil_hessians<K>(state.range(0) == 0);
  auto work = given;
  for (auto _ : state) {
    work = given;  // a small part of the time
    for (auto& h : work) project_stencil_psd<K>(h, Projection::clamp);
    benchmark::DoNotOptimize(work.data());
  }
  state.SetItemsProcessed(state.iterations() * count);
}
BENCHMARK_TEMPLATE(psd_projection, 2)->ArgName("indefinite")->Arg(0)->Arg(1)->UseRealTime();
BENCHMARK_TEMPLATE(psd_projection, 3)->ArgName("indefinite")->Arg(0)->Arg(1)->UseRealTime();
BENCHMARK_TEMPLATE(psd_projection, 4)->ArgName("indefinite")->Arg(0)->Arg(1)->UseRealTime();

}  // namespace
}  // namespace tack::bench
