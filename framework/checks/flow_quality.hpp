// Quality of tets that flow plastically. Large flow flattens and stretches elements for good: flat
// elements are too stiff in bending, slow down solvers, and truncate steps when they are about to
// invert. The quality of a tet that has flowed is its mean ratio q now, over q at rest:
//     q = 1 for a regular tet, 0 for a flat one (geometry/tets/mean_ratio.hpp).
// Elastic strains are small against such flow, so that this is nearly the shape without stress.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/core/warning.hpp"
#include "framework/world/world.hpp"

namespace tack {

class FlowQuality {
 public:
  // Examines all objects whose terms publish the plastic strain of tets.
  explicit FlowQuality(const World& world);

  // Examines the configuration x (3n) at a time [s]; called between steps.
  void examine(const VecX& x, double time);
  std::optional<double> lowest() const { return lowest_; }  // so far
  // Returns a line for each object whose lowest quality is too low.
  std::vector<Warning> warnings() const;

 private:
  struct Flowing {
    const FieldRecord* strain;
    int body;
    std::vector<double> at_rest;                      // per tet: its mean ratio
    double lowest = 1, plastic_strain = 0, time = 0;  // -, of that tet, s
    int tet = -1;
    Vec3 place = Vec3::Zero();  // m
  };
  const World& world_;
  std::vector<Flowing> all_;
  std::optional<double> lowest_;
};

}  // namespace tack
