// Set of vertices of an object, by position at rest, tag or index.
#pragma once

#include <vector>

#include "framework/body/body.hpp"
#include "framework/config/registry.hpp"

namespace tack {

struct SelectionContext {
  const Body& body;
  const VecX& rest;  // 3n
};

class Selection : public Component {
 public:
  static constexpr const char* kind_name = "selection";
  static constexpr const char* kind_doc = "Chooses vertices of an object.";
  // Returns the chosen vertices (global, ascending). Throws InputError, e.g. for an unknown tag.
  virtual std::vector<int> choose(const SelectionContext& context) const = 0;
};

// Returns the chosen vertices (global, ascending). Throws InputError if there are none.
std::vector<int> select(const Selection& selection, const SelectionContext& context);

}  // namespace tack
