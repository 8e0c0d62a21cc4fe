// An energy of an object, chosen in the scene file; it makes the term that is assembled.
#pragma once

#include <memory>
#include <optional>

#include "framework/body/selection.hpp"
#include "framework/core/term.hpp"

namespace tack {

class Energy : public Component {
 public:
  static constexpr const char* kind_name = "energy";
  static constexpr const char* kind_doc = "A potential energy of an object, with its material.";

  // What derives from it lists its own behind these.
  void fields(Fields& f) override;
  // It acts on the elements all of whose vertices this chooses (selected_elements.hpp); null: on all.
  const Selection* selection() const { return select_.get(); }

  // rest: the rest configuration of all vertices (3n). Throws InputError if the body lacks the
  // elements that the energy needs. Null: inertia alone.
  virtual std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const = 0;
  // Whether what it makes of tets depends on what elements they are (Body::elements).
  virtual bool takes_elements() const { return false; }
  // Whether it asks for the twist of edges (Body::rod).
  virtual bool twists() const { return false; }
  // Adds the body's lumped mass [kg] per vertex.
  virtual void add_mass(const Body& /*body*/, const VecX& /*rest*/, VecX& /*mass*/) const {}
  // The stiffness that adhesion and barrier are scaled by [Pa].
  virtual std::optional<double> young() const { return std::nullopt; }
  // Poisson's ratio of what fills volumes.
  virtual std::optional<double> poisson() const { return std::nullopt; }
  // The bending stiffness of a sheet or a rod, per width [N m]; 0 if it does not resist bending.
  virtual double bending_stiffness(const Body& /*body*/) const { return 0; }

 private:
  std::unique_ptr<Selection> select_;
};

}  // namespace tack
