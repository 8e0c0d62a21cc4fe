// Adhesion laws that `tack law` studies, read from a scene, a file or a type.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/law/studied_law.hpp"

namespace tack {

struct LawSource {
  std::string file, type;             // file of a scene or an adhesion; or the type of an adhesion
  std::vector<std::string> settings;  // "a.b=c": overrides of the scene or the adhesion
  // [m, Pa, Pa]. The first two are refused for a scene, which has its own.
  std::optional<double> contact_distance, barrier_stiffness, young;
  // Temperature of bonds [K]; else that of the scene at time 0 in the middle of the surfaces, or
  // room temperature. Refused for laws that do not depend on it.
  std::optional<double> temperature;
};

// Returns each adhesion law of a scene once, or the single law. Throws InputError with the source
// location and the remedy.
std::vector<StudiedLaw> laws_of(const LawSource& source);

}  // namespace tack
