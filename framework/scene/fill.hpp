// Many copies of an object in a region, at random and apart from each other.
//
// An object with `fill` stands for its copies: before anything is built, the entry of the scene's tree is replaced by one for
// each copy, with a place of its own, named after it with a number and in a group of its name. So whatever reads the
// scene sees objects alone, and messages name the line of the entry that they came from.
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

// root: what `scene` was bound from. Throws InputError, with the place of the entry, if copies do not fit.
Value filled(Value root, const SceneConfig& scene);

}  // namespace tack
