// History variables: named arrays of numbers that are part of the state, beside positions and
// velocities. They are written only when a step is accepted, so that a rejected step needs no
// rollback. Checkpoints and saved problems contain all of them.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace tack {

/// One named array of history variables.
struct HistoryArray {
  int width = 1;               // numbers per entry
  std::vector<double> values;  // entry by entry
  // Keys (vertex, object) of entries that belong to a point and another object, ascending. Empty:
  // entry i belongs to element i, or vertex i, of the owner.
  std::vector<std::array<int, 2>> keys;

  int entries() const { return static_cast<int>(values.size()) / width; }
  bool operator==(const HistoryArray&) const = default;
};

/// History arrays by name: "<object>/<variable>".
using History = std::map<std::string, HistoryArray>;

/// Returns the values of the array `name`; null if there is none (at the start of a run). Throws
/// std::logic_error if its width or number of entries differs: two owners then use one name.
const std::vector<double>* history_values(const History& history, const std::string& name,
                                          int width, int entries);

}  // namespace tack
