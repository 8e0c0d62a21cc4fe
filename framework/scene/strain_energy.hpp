// An energy of rods or sheets that is quadratic in strains, beside which branches relax.
#pragma once

#include <memory>
#include <string_view>

#include "framework/core/term.hpp"

namespace tack {

struct Body;

/// Second base of such energies.
class StrainEnergy {
 public:
  /// Makes the term with all its stiffnesses times `scale`; it is a StrainSpring
  /// (strain_spring.hpp).
  virtual std::unique_ptr<Term> make_scaled(const Body& body, const VecX& rest,
                                            double scale) const = 0;
  /// Returns the type of the branches.
  virtual std::string_view branch() const = 0;

 protected:
  ~StrainEnergy() = default;
};

}  // namespace tack
