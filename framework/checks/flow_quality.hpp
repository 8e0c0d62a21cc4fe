// Whether the elements of solids that flow plastically still have a shape. Large flow flattens and stretches them for good, and what was a good mesh
// at rest is none any more: flat elements are stiff where they should bend and slow where solvers have to take them, and steps are cut by those that
// are about to invert. Of each tet that has flowed, the quality is its mean ratio now, over that which it had at rest:
//     q, 1 for a regular tet and 0 for a flat one (geometry/tets/mean_ratio.hpp).
// Elastic strains are small beside such flow, so that this is the shape that it would have without stress.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/world/world.hpp"

namespace tack {

class FlowQuality {
 public:
  // Of all whose terms publish the plastic strain of tets.
  explicit FlowQuality(const World& world);

  // At the configuration x at a time [s]; between steps.
  void look(const VecX& x, double time);
  std::optional<double> lowest() const { return lowest_; }  // that was seen
  // A line for each object whose lowest quality is too low.
  std::vector<std::string> poor() const;

 private:
  struct Flowing {
    const FieldRecord* strain;
    int body;
    std::vector<double> at_rest;  // per tet: its mean ratio
    double lowest = 1, plastic_strain = 0, time = 0;  // -, of that tet, s
    int tet = -1;
    Vec3 place = Vec3::Zero();    // m
  };
  const World& world_;
  std::vector<Flowing> all_;
  std::optional<double> lowest_;
};

}  // namespace tack
