#include "framework/sensitivity/history_jumps.hpp"

#include <algorithm>
#include <cmath>

namespace tack {
namespace {

constexpr double jump = 1e-3;       // relative; the scenes differ by 1e-6
constexpr double rounding = 1e-12;  // relative

bool is_integer(double a) { return a == std::floor(a); }

// Returns true for a jump. Counts and choices are integers: any change is a jump.
bool jumps(double a, double b, double scale) {
  if (a == b) return false;
  return (is_integer(a) && is_integer(b)) || !(std::abs(a - b) <= jump * std::max({std::abs(a), std::abs(b), scale}));
}

// Returns the scale of each number of an entry. Entries of elements are of one kind (a tensor, a
// frame), whose small numbers may be noise: one scale for all. Entries with keys mix positions and
// measures.
std::vector<double> scales_of(const HistoryArray& array) {
  std::vector<double> largest(array.width, 0.0);
  for (size_t i = 0; i < array.values.size(); ++i) largest[i % array.width] = std::max(largest[i % array.width], std::abs(array.values[i]));
  const double all = *std::max_element(largest.begin(), largest.end());
  for (double& scale : largest) scale = array.keys.empty() ? all : std::max(scale, rounding * all / jump);
  return largest;
}

int take_entries(const HistoryArray& run, HistoryArray& other) {
  const std::vector<double> scale = scales_of(run);
  int taken = 0;
  for (int e = 0; e < run.entries(); ++e) {
    const double *from = run.values.data() + e * run.width, *end = from + run.width;
    double* to = other.values.data() + e * run.width;
    bool differs = false;
    for (int k = 0; k < run.width; ++k) differs = differs || jumps(from[k], to[k], scale[k]);
    if (!differs) continue;
    std::copy(from, end, to);
    ++taken;
  }
  return taken;
}

// Merges arrays with different keys: entries of `other` whose keys occur equally often in both are
// kept, the others come from the run.
int take_array(const HistoryArray& run, HistoryArray& other) {
  HistoryArray merged = run;
  int kept = 0;
  size_t j = 0;
  for (size_t i = 0; i < run.keys.size() && other.width == run.width;) {
    const auto& key = run.keys[i];
    size_t n = 0, m = 0;
    while (i + n < run.keys.size() && run.keys[i + n] == key) ++n;
    while (j < other.keys.size() && other.keys[j] < key) ++j;
    while (j + m < other.keys.size() && other.keys[j + m] == key) ++m;
    if (n == m) {
      std::copy_n(other.values.begin() + static_cast<std::ptrdiff_t>(j * run.width), n * run.width,
                  merged.values.begin() + static_cast<std::ptrdiff_t>(i * run.width));
      kept += static_cast<int>(n);
    }
    i += n;
    j += m;
  }
  const int others = std::max(run.entries(), other.entries()) - kept;
  other = std::move(merged);
  return others + take_entries(run, other);
}

}  // namespace

int replace_jumps(const History& run, History& other) {
  int taken = 0;
  std::erase_if(other, [&](const auto& entry) {
    const bool unknown = run.find(entry.first) == run.end();
    if (unknown) taken += entry.second.entries();
    return unknown;
  });
  for (const auto& [name, array] : run) {
    const auto found = other.find(name);
    if (found == other.end()) {
      other[name] = array;
      taken += array.entries();
    } else if (found->second.keys != array.keys || found->second.values.size() != array.values.size()) {
      taken += take_array(array, found->second);
    } else {
      taken += take_entries(array, found->second);
    }
  }
  return taken;
}

}  // namespace tack
