// Short names of keys.
#pragma once

#include <string>
#include <vector>

namespace tack {

// Returns the shortest end of a key that no other of `keys` has: "young" of
// "objects.cube.energies.0.young".
std::string short_key(const std::string& key, const std::vector<std::string>& keys);

}  // namespace tack
