// A line in a plane, by its corners or by formulas, in cells: what shapes are swept from.
#pragma once

#include <string>
#include <vector>

#include "framework/config/field.hpp"

namespace tack {

struct ProfileConfig {
  std::vector<Vec2> corners;  // m
  std::string x, y;           // formulas of s, from 0 to 1 [m]; empty: none
  bool closed = false;
  int cells = 16;

  // `first`: what x is, "distance from the axis".
  void fields(Fields& f, const std::string& first);

  // Its points [m]; of a closed one, the first follows the last. Throws InputError, beginning with `name`, for a formula that gives no place.
  std::vector<Vec2> points(const std::string& name) const;

 private:
  std::vector<Vec2> of_formulas(const std::string& name) const;
};

// The longest piece between points, and that from the last to the first [m].
double longest_piece(const std::vector<Vec2>& closed);

}  // namespace tack
