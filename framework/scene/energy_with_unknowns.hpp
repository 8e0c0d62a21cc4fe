// An energy with unknowns beyond the vertices of its object.
#pragma once

#include <stdexcept>

#include "framework/scene/energy.hpp"
#include "framework/world/unknowns.hpp"

namespace tack {

class EnergyWithUnknowns : public Energy {
 public:
  // Makes the term as Energy::make_term does. `rest` includes the unknowns requested so far.
  virtual std::unique_ptr<Term> make_with_unknowns(const Body& body, const VecX& rest,
                                                   Unknowns unknowns) const = 0;
  std::unique_ptr<Term> make_term(const Body&, const VecX&) const final {
    throw std::logic_error("an energy that asks for unknowns is made with a builder");
  }
};

}  // namespace tack
