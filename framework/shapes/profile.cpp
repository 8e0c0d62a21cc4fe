#include "framework/shapes/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/config/formula.hpp"
#include "geometry/errors.hpp"
#include "geometry/shapes/swept.hpp"

namespace tack {
namespace {

const std::vector<std::string> along = {"s"};
constexpr int cell_count_max = 1'000'000;

std::string problem_of(const std::string& text) {
  if (text.empty()) return "";
  try {
    Formula(text, along);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

void ProfileConfig::fields(Fields& f, const std::string& first) {
  f.vectors("profile", corners, units::length, "corners (x, y), x the " + first);
  f.text("profile_x", x, "instead of corners: x [m], a formula of s, from 0 to 1").formula(along);
  f.text("profile_y", y, "instead of corners: y [m], a formula of s, from 0 to 1").formula(along);
  f.flag("closed", closed, "the last point joins the first, and the interior is filled with tets; false: a sheet");
  f.integer("cells_profile", cells, "cells along the profile").range(1, cell_count_max);
  f.check("profile_x", [this] { return problem_of(x); });
  f.check("profile_y", [this] { return problem_of(y); });
  f.check("profile", [this]() -> std::string {
    if (corners.empty() == (x.empty() || y.empty()) || (!corners.empty() && !(x.empty() && y.empty())))
      return "give either its corners, profile: [[x, y], ...], or formulas, profile_x and profile_y";
    if (!corners.empty() && corners.size() < (closed ? 3u : 2u)) return closed ? "a closed one needs three corners or more" : "needs two corners or more";
    for (size_t i = 0; i + 1 < corners.size(); ++i)
      if (corners[i] == corners[i + 1]) return fmt::format("its corners {} and {} (from 0) are one", i, i + 1);
    return "";
  });
}

std::vector<Vec2> ProfileConfig::of_formulas(const std::string& name) const {
  const Formula x_of(x, along), y_of(y, along);
  std::vector<Vec2> points;
  for (int i = 0; i <= cells; ++i) {
    const std::array s = {double(i) / cells};
    points.emplace_back(x_of(s), y_of(s));
    if (!points.back().allFinite()) throw InputError(fmt::format("{}: ({}, {}) is no position at s = {:g}", name, x, y, s[0]));
  }
  return points;
}

std::vector<Vec2> ProfileConfig::points(const std::string& name) const {
  constexpr double round_off = 1e-9;
  if (x.empty()) {
    const bool twice = closed && corners.front() == corners.back();
    return divided({corners.begin(), corners.end() - (twice ? 1 : 0)}, closed, cells);
  }
  std::vector<Vec2> points = of_formulas(name);
  if (!closed) return points;
  const double closing_length = (points.back() - points.front()).norm(), longest = [&] {
    double length = 0;
    for (size_t i = 0; i + 1 < points.size(); ++i) length = std::max(length, (points[i + 1] - points[i]).norm());
    return length;
  }();
  if (closing_length <= round_off * longest * cells) {
    points.pop_back();
    return points;
  }
  // A straight line closes the profile.
  for (const Vec2& p : divided({points.back(), points.front()}, false, std::max(1, static_cast<int>(std::lround(closing_length / longest)))))
    if (p != points.back() && p != points.front()) points.push_back(p);
  return points;
}

double longest_segment(const std::vector<Vec2>& closed) {
  double longest = 0;
  for (size_t i = 0; i < closed.size(); ++i) longest = std::max(longest, (closed[(i + 1) % closed.size()] - closed[i]).norm());
  return longest;
}

}  // namespace tack
