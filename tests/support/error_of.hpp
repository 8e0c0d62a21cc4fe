// The error of a scene that is refused.
#pragma once

#include <string>

#include "geometry/errors.hpp"

namespace tack {

/// Returns the InputError of Made(yaml), "" if there is none. Made: TestScene or TestRun.
template <class Made>
std::string error_of(const std::string& yaml) {
  try {
    const Made made(yaml);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace tack
