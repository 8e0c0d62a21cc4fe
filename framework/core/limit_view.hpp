// Access to limits that a term enforces by an infinite energy: strains, angles. Line searches
// accept no configuration beyond them, but a prescribed motion or an initial state may demand one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

/// A limit that a configuration exceeds.
struct ExceededLimit {
  std::vector<int> vertices;  // of the element; empty: the excess names what it belongs to
  std::string excess;         // "would have ..., and ... allows less than ..."
};

/// Second base class of terms that enforce limits.
class LimitView {
 public:
  /// Returns the element that exceeds its limit most at x (3n); none if all are within limits.
  virtual std::optional<ExceededLimit> exceeded_limit(const VecX& x) const = 0;

 protected:
  ~LimitView() = default;
};

}  // namespace tack
