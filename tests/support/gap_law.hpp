// Adhesion laws of the gap from text, ready for a pair.
#pragma once

#include <catch2/catch.hpp>

#include "framework/contact/normal_law.hpp"
#include "tests/framework/config/toy.hpp"
#include "tests/support/component_variants.hpp"

namespace tack {

inline std::unique_ptr<NormalAdhesion> law_of(const std::string& yaml,
                                              double contact_distance = 1e-6) {
  std::unique_ptr<NormalAdhesion> law(
      dynamic_cast<NormalAdhesion*>(component<AdhesionLaw>(yaml).release()));
  REQUIRE(law);
  law->prepare({.contact_distance = contact_distance});
  return law;
}
// The message with which it is refused.
inline std::string error_of(const std::string& yaml, double contact_distance = 1e-6) {
  return toy::message_of([&] { law_of(yaml, contact_distance); });
}

}  // namespace tack
