#include "framework/view/preview_motion.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "tests/support/scene.hpp"

using namespace tack;

namespace {

const std::string head = "time: {step: 0.01 s, duration: 1 s}\nobjects:\n";
const std::string free_box = "  - {name: free, shape: {type: box, size: [1, 1, 1]}, place: {translate: [5, 0, 0]}, energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3, density: 1000}]}\n";

PrescribedFrames frames_of(const std::string& objects, int frames = 5) {
  const TestScene scene(head + objects + free_box);
  return prescribed_frames(scene.built.world(), 1, frames);
}

Vec3 place(const PrescribedFrames& shown, size_t frame, int vertex) { return shown.positions[frame].segment<3>(3 * vertex); }

}  // namespace

TEST_CASE("rotating vertices follow their motion at each time, and free ones stay") {
  const PrescribedFrames shown = frames_of("  - {name: plate, shape: {type: box, size: [2, 1, 1]}, motion: [{type: rotate, axis: [0, 1, 0], angular_velocity: 90 deg/s}]}\n");
  REQUIRE(shown.times == std::vector<double>{0, 0.25, 0.5, 0.75, 1});
  for (int v = 0; v < 8; ++v) {
    const Vec3 start = place(shown, 0, v);
    for (size_t i = 0; i < 5; ++i) {
      const double angle = shown.times[i] * std::numbers::pi / 2;
      const Vec3 turned(start.x() * std::cos(angle) + start.z() * std::sin(angle), start.y(), -start.x() * std::sin(angle) + start.z() * std::cos(angle));
      CHECK((place(shown, i, v) - turned).norm() < 1e-12);
      CHECK((place(shown, i, v + 8) - place(shown, 0, v + 8)).norm() == 0);
    }
  }
}

TEST_CASE("a motion between frames starts from the positions at its start, and ends at its release") {
  const PrescribedFrames shown = frames_of("  - {name: plate, shape: {type: box, size: [2, 1, 1]}, energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3, density: 1000}], "
                                         "motion: [{type: translate, velocity: [1, 0, 0], until: 0.3 s}, "
                                         "{type: translate, velocity: [0, 2, 0], from: 0.6 s, until: 0.9 s}]}\n");
  REQUIRE(shown.times.size() == 5);
  const std::vector<Vec3> moved = {{0, 0, 0}, {0.25, 0, 0}, {0.3, 0, 0}, {0.3, 0.3, 0}, {0.3, 0.6, 0}};
  for (size_t i = 0; i < moved.size(); ++i) {
    CAPTURE(i);
    CHECK((place(shown, i, 3) - place(shown, 0, 3) - moved[i]).norm() < 1e-12);
  }
}

TEST_CASE("a scene without motion has one frame, the start") {
  const PrescribedFrames shown = frames_of("  - {name: floor, shape: {type: box, size: [2, 1, 1]}, motion: [fixed]}\n");
  CHECK(shown.times == std::vector<double>{0});
  CHECK(shown.positions.size() == 1);
  CHECK(shown.problem.empty());
}
