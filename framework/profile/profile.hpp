// Profile of a run (`tack profile`): tables of its costs, and remarks on keys to change. Origin of
// each number: docs/profiling.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/profile/core_scaling.hpp"
#include "framework/profile/isolated_pair.hpp"

namespace tack {

struct PairCost {
  std::string first, second;  // objects; equal for self-contact
  PairCount count;            // sums over the steps, each as it stood at its end
  int touching_steps = 0;     // at whose end it had active stencils
  ContactSeconds seconds;

  bool is_self() const { return first == second; }
};

struct TermCost {
  std::string name;     // "neo_hookean of 'block'"
  double elements = 0;  // stencils; of contact and friction the mean over the steps
  TermTime time;
  double seconds() const { return time.seconds[0] + time.seconds[1] + time.seconds[2]; }
};

struct HardStep {
  int step = 0;
  double time = 0;  // at its end [s]
  int iterations = 0;
  // Cause of its most truncated Newton step: describe_blocker(); empty if none was truncated
  std::string blocker;
};

struct LinearCost {
  std::string description;  // linear solver and reason; empty for minimisers without
  long systems = 0, iterations = 0, factorizations = 0;
  bool automatic = false;  // the scene left the choice to `auto`
};

// Steps that minimisers requested, and how many of them contact or inversion truncated below 0.9.
struct TruncatedSteps {
  long tried = 0, cut = 0;
  double left = 0;  // sum of the permitted fractions of truncated steps
};

// Distances of surfaces at the ends of steps with contact: the smallest distance over the contact
// distance.
struct Nearness {
  int steps = 0;
  double sum = 0;  // over these steps
  double mean() const { return steps > 0 ? sum / steps : 0; }
};

// Contact range of an object, to compare with its mesh.
struct ContactRange {
  std::string object;
  double edge = 0;   // mean length of its surface's edges [m]
  double range = 0;  // the largest of the laws between it and others [m]
};

struct Profile {
  int steps = 0;
  long iterations = 0;
  int most_iterations = 0;                         // of a step
  long line_search_evaluations = 0, searches = 0;  // searches: of candidates
  int failed_solves = 0;
  long lag_iterations = 0;
  PhaseClock::Seconds phases{};
  std::vector<PairCost> pairs;  // most expensive first
  ContactSeconds uncharged;     // of contact, while no pair had candidates
  std::vector<TermCost> terms;  // most expensive first
  double gather_seconds = 0;    // assembly, without the terms
  LinearCost linear;
  std::vector<HardStep> hardest;  // most iterations first
  TruncatedSteps cuts;
  Nearness nearness;
  std::vector<ContactRange> contact_ranges;  // of objects that move, longest in edges first
  CoreScaling scaling;                       // empty unless asked for

  double seconds() const;
  double contact_seconds() const;  // of all pairs, and uncharged
  double phase(Phase phase) const { return phases[static_cast<int>(phase)]; }
};

// Returns at most five remarks, the most expensive first: a measurement, and the key to change.
std::vector<std::string> remarks_on(const Profile& profile);

// Returns the profile as text for a terminal.
std::string profile_tables(const Profile& profile);
// Returns the tables of the prediction for several cores; "" if it is empty.
std::string scaling_tables(const CoreScaling& scaling);
// Heading of the table of pairs, if there are any.
inline constexpr const char* contact_heading = "contact, counts per step";

// Writes the profile as a table with the columns table, row, quantity, value; values may be text.
// Throws InputError if the file cannot be written.
void write_profile(const std::filesystem::path& path, const Profile& profile);

}  // namespace tack
