// Resolves chains of multi-point constraints (dependence.hpp) to independent vertices.
#pragma once

#include <cmath>
#include <map>
#include <vector>

#include "framework/core/dependence.hpp"
#include "geometry/errors.hpp"

namespace tack {

/// Weights of independent vertices, computed on demand.
class IndependentVertices {
 public:
  // The dependences must outlive this object.
  IndependentVertices(int vertices, const Dependences& dependences)
      : of_(vertices, nullptr), state_(vertices, fresh), independent_(vertices) {
    for (const Dependence& d : dependences) of_[d.vertex] = &d;
  }

  bool depends(int v) const { return of_[v] != nullptr; }

  /// Returns the weights of the independent vertices of v. Throws InputError if v depends on
  /// itself.
  const std::map<int, double>& of(int v) {
    if (state_[v] == done) return independent_[v];
    if (state_[v] == open)
      throw InputError(
          "vertices follow each other in a circle (attach); let one of the objects lead");
    state_[v] = open;
    if (!of_[v]) {
      independent_[v] = {{v, 1.0}};
    } else {
      for (const auto& [on, weight] : of_[v]->on)
        for (const auto& [vertex, factor] : of(on)) independent_[v][vertex] += weight * factor;
      std::erase_if(independent_[v],
                    [](const auto& entry) { return std::abs(entry.second) < no_weight; });
    }
    state_[v] = done;
    return independent_[v];
  }

 private:
  static constexpr double no_weight = 1e-13;  // bound of the round-off of weights that cancel
  enum State : char { fresh, open, done };
  std::vector<const Dependence*> of_;
  std::vector<State> state_;
  std::vector<std::map<int, double>> independent_;
};

}  // namespace tack
