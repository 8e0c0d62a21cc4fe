// Line in a plane, by corners or by formulas, divided into cells: the profile of swept shapes.
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

  // first: meaning of x, "distance from the axis".
  void fields(Fields& f, const std::string& first);

  // Returns the points [m]; in a closed line, the first one follows the last. Throws InputError,
  // with a message that begins with `name`, for a formula without a finite value.
  std::vector<Vec2> points(const std::string& name) const;

 private:
  std::vector<Vec2> of_formulas(const std::string& name) const;
};

// Returns the longest segment of a closed polygon [m].
double longest_segment(const std::vector<Vec2>& closed);

}  // namespace tack
