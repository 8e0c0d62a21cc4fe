// A number whose dimension is not known where it is read: that of a probe, which an expectation names.
#pragma once

#include <string>

#include "framework/config/units.hpp"

namespace tack {

struct Quantity {
  double si = 0;
  std::string written;  // "5 mN"; empty if it was not read

  operator double() const { return si; }
  // Throws InputError, without a place, if it was written in a unit of another dimension.
  void check(const Unit& unit) const {
    if (!written.empty()) to_si(written, unit);
  }
};

}  // namespace tack
