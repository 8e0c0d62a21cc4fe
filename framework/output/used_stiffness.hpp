// Stiffness of contact and affine bodies in a run, given or computed, for summary.json and the end
// of the resolved scene.yaml.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace tack {

struct World;

struct UsedStiffness {
  struct Barrier {
    std::array<std::string, 2> between;  // first pair with this stiffness
    double pairs = 0;                    // number of such pairs
    double stiffness = 0;                // Pa: the barrier's key `stiffness`
  };
  struct Affine {
    std::string object;    // first object with this stiffness
    int objects = 0;       // number of such objects
    double stiffness = 0;  // Pa
  };
  std::vector<Barrier> barriers;
  std::vector<Affine> affine;
};

UsedStiffness used_stiffness(const World& world);

// Returns the names of the bodies of each meeting group (world/meeting_groups.hpp), the groups that
// computed stiffness belongs to.
std::vector<std::vector<std::string>> meeting_names(const World& world);

// Returns YAML comments; "" if there are none.
std::string comments_of(const UsedStiffness& used);

}  // namespace tack
