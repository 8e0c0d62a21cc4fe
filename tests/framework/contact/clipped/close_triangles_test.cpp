// Pairs of triangles that may interact while vertices move a little, against random motions.
#include "framework/contact/clipped/close_triangles.hpp"

#include <catch2/catch.hpp>

#include <random>

#include "framework/contact/clipped/clipped_pair.hpp"

using namespace tack;

namespace {

constexpr double law_range = 0.4;

// One joule per square metre up to the range.
class EvenLaw final : public NormalLaw {
 public:
  std::string_view name() const override { return "even"; }
  void prepare(const PairMaterials&) override {}
  double range() const override { return law_range; }
  void add_samples(int n, const double* d, LawSample* out) const override {
    for (int i = 0; i < n; ++i) out[i].value += d[i] < law_range;
  }
  void add_values(int n, const double* d, double* out) const override {
    for (int i = 0; i < n; ++i) out[i] += d[i] < law_range;
  }
  std::unique_ptr<NormalLaw> clone() const override { return std::make_unique<EvenLaw>(*this); }
};

}  // namespace

TEST_CASE("close triangles: no motion within the margin makes other triangles interact", "[clipped]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto random_vector = [&] { return Vec3(u(random), u(random), u(random)); };
  PairLaw law;
  law.add(std::make_shared<EvenLaw>());
  ClipIntegrator integrator;
  int left_out = 0, interact = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    ClippedPair pair;
    for (int k = 0; k < 3; ++k) {
      pair.a[k] = Vec3(0, 0, 0.3) + random_vector();
      pair.b[k] = random_vector();
    }
    const double motion = trial % 3 == 0 ? 0.2 : 0.02;
    VecX x(18);
    for (int k = 0; k < 6; ++k) vertex(x, k) = k < 3 ? pair.a[k] : pair.b[k - 3];
    CloseTriangles test(motion);
    const int lane = trial % pack_width;
    test.set(lane, x, {0, 1, 2, 3, 4, 5}, law_range, trial % 2);
    const bool close = (test.test().close >> lane & 1u) != 0;
    left_out += !close;
    // Corners move as far as they may, so that margins are used up.
    for (int repeat = 0; repeat < 20; ++repeat) {
      ClippedPair moved = pair;
      for (int k = 0; k < 3; ++k) {
        moved.a[k] += motion * random_vector().normalized();
        moved.b[k] += motion * random_vector().normalized();
      }
      if (!(integrator.value(moved, law, {0, law_range}).energy > 0)) continue;
      ++interact;
      REQUIRE(close);
    }
  }
  CHECK(left_out > 4000);
  CHECK(interact > 4000);
}
