// The stiffness of contact and of affine bodies that a run uses, given or found (summary.json, and
// the end of the resolved scene.yaml).
#pragma once

#include <array>
#include <string>
#include <vector>

namespace tack {

struct World;

struct UsedStiffness {
  struct Barrier {
    std::array<std::string, 2> between;  // the first two objects of which this is true
    double pairs = 0;                    // how many pairs there are
    double stiffness = 0;                // Pa: the barrier's key `stiffness`
  };
  struct Affine {
    std::string object;  // the first one
    int objects = 0;     // how many there are
    double stiffness = 0;  // Pa
  };
  std::vector<Barrier> barriers;
  std::vector<Affine> affine;
};

UsedStiffness used_stiffness(const World& world);

// The names of the bodies of each meeting group (world/meeting_groups.hpp): the groups to which
// stiffness, where it is found, belongs.
std::vector<std::vector<std::string>> meeting_names(const World& world);

// As comments of a YAML file; "" if there are none.
std::string comments_of(const UsedStiffness& used);

}  // namespace tack
