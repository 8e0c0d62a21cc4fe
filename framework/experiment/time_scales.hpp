// Time scales of a scene before it is run: number of steps, and duration of elastic waves.
#pragma once

#include <optional>
#include <string>

#include "framework/experiment/experiment.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Returns "300 steps of 2 ms, to 0.6 s"; with adaptive steps their smallest and largest size, with
// protocols, which end a run earlier, the largest number.
std::string steps_text(const Experiment& experiment);

// Returns the time that the slowest elastic wave, of speed sqrt(E / rho) with E the softest Young's
// modulus, takes through the longest side of a solid [s]; nothing for other bodies and without
// inertia.
std::optional<double> wave_time(const Experiment& experiment, const World& world, int body);

// Returns a time with the unit that suits it: "2.5 ms".
std::string time_text(double seconds);

}  // namespace tack
