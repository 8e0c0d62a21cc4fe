// A function that is linear between points and constant outside them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <ranges>

namespace tack {

/// Returns the function at x. count: number of points, at least 1. at(i), value(i): of point i, at
/// ascending.
template <class At, class Value>
double piecewise_linear(std::size_t count, const At& at, const Value& value, double x) {
  const auto points = std::views::iota(std::size_t{0}, count);
  const auto next = static_cast<std::size_t>(
      std::ranges::partition_point(points, [&](std::size_t i) { return !(x < at(i)); }) -
      points.begin());
  if (next == 0) return value(0);
  if (next == count) return value(count - 1);
  const double s = (x - at(next - 1)) / (at(next) - at(next - 1));
  return (1 - s) * value(next - 1) + s * value(next);
}

}  // namespace tack
