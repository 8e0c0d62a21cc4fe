// What bodies remember from step to step beside where they are: named arrays of numbers, part of the state.
// They are written when a step is kept and at no other time, so that a step that is given up leaves them as they
// were; checkpoints and problems hold them all.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace tack {

struct HistoryArray {
  int width = 1;               // numbers of an entry
  std::vector<double> values;  // entry by entry
  // Of entries that belong to a point and another object: (vertex, object) of each, ascending. Empty: entry i is
  // that of element i, or vertex i, of whoever remembers.
  std::vector<std::array<int, 2>> keys;

  int entries() const { return static_cast<int>(values.size()) / width; }
  bool operator==(const HistoryArray&) const = default;
};

using History = std::map<std::string, HistoryArray>;  // by name: that of the object, "/" and what it is

// The values of an array that has so many entries of that width; null where there is none (a run begins).
// Throws std::logic_error for an array of another shape: names must differ.
const std::vector<double>* remembered(const History& history, const std::string& name, int width, int entries);

}  // namespace tack
