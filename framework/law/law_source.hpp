// Laws for `tack law`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/law/studied_law.hpp"

namespace tack {

struct LawSource {
  std::string file, type;              // a scene or a file of an adhesion; or the type of one
  std::vector<std::string> settings;   // "a.b=c": of the scene or of the adhesion
  // [m, Pa, Pa]; the first two without a scene
  std::optional<double> contact_distance, barrier_stiffness, young;
};

// Returns one of each law of the pairs of a scene. Throws InputError with place and remedy.
std::vector<StudiedLaw> laws_of(const LawSource& source);

}  // namespace tack
