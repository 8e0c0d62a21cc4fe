// Contact where few vertices move: the part of a search for active stencils that depends on them.
#pragma once

#include <vector>

#include "framework/contact/stencils/contact_set.hpp"

namespace tack {

/// Made by ContactPotential::local() for some vertices, which alone move. Valid until the
/// candidates of the system change or the next step begins.
class LocalContact {
 public:
  virtual ~LocalContact() = default;
  /// Returns the vertices of all stencils that find() may find, ascending.
  virtual const std::vector<int>& vertices() const = 0;
  /// Finds the active stencils at x (3n) that may depend on the moving vertices; others may be
  /// among them.
  virtual void find(const VecX& x, ContactSet& contacts) = 0;
};

}  // namespace tack
