// Random copies of an object in a region, at a distance from each other.
// Before anything is built, an entry with `fill` in the scene's tree is replaced by one entry per
// copy, each with its own placement, the name of the entry with a number, and a group of the
// entry's name. Thus other code only sees objects, and messages give the line of the original
// entry.
#pragma once

#include <memory>
#include <optional>

#include "framework/level_set/level_set.hpp"

namespace tack {

struct FillConfig {
  enum class Into { objects, one };
  std::unique_ptr<LevelSet> region;
  std::optional<int> count;
  std::optional<double> packing;
  double clearance = 0;  // m
  bool rotate = true;
  int seed = 1;
  Into into = Into::objects;
  void fields(Fields& f);
};

struct SceneConfig;

// Returns the tree with copies. root: the tree that `scene` was bound from. Throws InputError, with
// the entry's source location, if the copies do not fit.
Value expand_fills(Value root, const SceneConfig& scene);

}  // namespace tack
