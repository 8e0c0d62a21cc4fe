// Contact of a scene with a barrier and Fang's adhesion, and the values of these laws at a
// distance.
#pragma once

#include <fmt/format.h>

#include <string>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/contact/adhesion_law.hpp"
#include "framework/contact/normal_law.hpp"

namespace tack {

inline constexpr double dhat = 1e-3, gap = 1.3e-3;  // m; adhesion reaches to 2 dhat

inline std::string contact(const std::string& pair) {
  return fmt::format(
      "contact:\n  distance: {}\n  barrier: {{type: clamped_log, stiffness: 3e3}}\n  pairs: "
      "[{{{}}}]\n",
      dhat, pair);
}

inline const std::string sticks = ", adhesion: {type: fang, young: 1e4, critical_strain: 0.2}";

// phi of barrier and adhesion at a distance, and phi' [Pa].
inline LawSample laws_at(double distance, bool adhesive = true) {
  const auto barrier =
      bind_component<BarrierLaw>(parse_string("{type: clamped_log, stiffness: 3e3}", "t"));
  const auto fang = bind_component<AdhesionLaw>(
      parse_string("{type: fang, young: 1e4, critical_strain: 0.2}", "t"));
  auto* const adhesion = dynamic_cast<NormalLaw*>(fang.get());
  for (NormalLaw* law : {static_cast<NormalLaw*>(barrier.get()), adhesion})
    law->prepare({dhat, 1e5, 0});
  LawSample sum = barrier->at(distance);
  if (adhesive)
    sum.value += adhesion->at(distance).value, sum.slope += adhesion->at(distance).slope;
  return sum;
}

}  // namespace tack
