// Values of many terms at one configuration. Terms with few stencils are evaluated side by side,
// because each of them is a single chunk (a pile has hundreds).
#pragma once

#include <span>
#include <vector>

#include "framework/core/term.hpp"

namespace tack {

class TermTimes;

/// Number of small terms whose values are evaluated one after the other: 10 to 20 us.
inline constexpr int small_terms_per_chunk = 4;

/// Returns whether the term gives its stencils by ranges (StencilRanges) and has at most one chunk
/// of them. value() of such terms may be called in several threads and only reads.
bool is_small(const Term& term);

/// Evaluates the values of terms.
class TermValues {
 public:
  /// The terms must outlive it.
  explicit TermValues(std::span<const Term* const> terms);

  /// Returns the value of each term at x (3n) [J], in the order of the terms. times: may be null.
  std::vector<double> at(const VecX& x, TermTimes* times) const;

 private:
  std::vector<const Term*> terms_;
  std::vector<int> small_, others_;  // indices of terms
};

}  // namespace tack
