// `springs:` of a scene: between two objects.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "framework/config/field.hpp"
#include "framework/scene/selection.hpp"

namespace tack {

struct World;
struct SceneConfig;

struct SpringConfig {
  struct End {
    std::string object;
    std::unique_ptr<Selection> select = Registry<Selection>::make("all");
    void fields(Fields& f);
  };
  std::string name;
  End from, to;
  double stiffness = 1;                 // N/m
  std::optional<double> length;         // m
  std::optional<double> breaking_force;  // N
  void fields(Fields& f);
};

// One term for each entry: a spring from every vertex of `from` to the vertex of `to` that is nearest at rest.
void add_springs(const SceneConfig& scene, const Value& root, World& world);

}  // namespace tack
