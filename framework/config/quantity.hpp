// A number whose dimension is unknown when it is read, such as the value expected of a probe.
#pragma once

#include <string>

#include "framework/config/units.hpp"

namespace tack {

struct Quantity {
  double si = 0;
  std::string written;  // "5 mN"; empty if it was not read from a file

  operator double() const { return si; }
  // Throws InputError, without a source location, if its unit has another dimension.
  void check(const Unit& unit) const {
    if (!written.empty()) to_si(written, unit);
  }
};

}  // namespace tack
