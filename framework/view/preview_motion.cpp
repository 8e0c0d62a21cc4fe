#include "framework/view/preview_motion.hpp"

#include <algorithm>
#include <cmath>

#include "framework/stepping/fixed_vertices.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

bool any_motion_moves(const World& world) {
  const auto& assignments = world.prescribed_motion.assignments();
  return std::any_of(assignments.begin(), assignments.end(), [](const PrescribedMotion::Assignment& assignment) { return assignment.motion->moves(); });
}

// Returns the times of frames and of starts and ends of prescribed motions, which count from the
// positions at their start.
std::vector<double> key_times(const World& world, const std::vector<double>& frames) {
  std::vector<double> times = frames;
  for (const PrescribedMotion::Assignment& assignment : world.prescribed_motion.assignments())
    for (const double t : {assignment.motion->from(), assignment.motion->until()})
      if (t > 0 && t < frames.back()) times.push_back(t);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace

PrescribedFrames prescribed_frames(const World& world, double duration, int frames) {
  PrescribedFrames shown{{0.0}, {world.start.x}, ""};
  if (!(duration > 0) || frames < 2 || !any_motion_moves(world)) return shown;
  std::vector<double> times;
  for (int i = 0; i < frames; ++i) times.push_back(duration * i / (frames - 1));
  FixedVertices fixed(world.prescribed_motion, world.constraints, world.rest);
  State state = world.start;
  double before = 0;
  try {
    for (const double t : key_times(world, times)) {
      if (t <= 0) continue;
      fixed.activate(state, (before + t) / 2);
      fixed.set_positions(t, state.x);
      state.time = before = t;
      fixed.commit(state);
      if (!std::binary_search(times.begin(), times.end(), t)) continue;
      shown.times.push_back(t);
      shown.positions.push_back(state.x);
    }
  } catch (const SimulationError& error) {
    shown.problem = error.what();
  }
  return shown;
}

}  // namespace tack
