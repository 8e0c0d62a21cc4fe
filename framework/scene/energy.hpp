// An energy of an object, chosen in the scene file; it makes the term that is assembled.
#pragma once

#include <memory>
#include <optional>

#include "framework/body/selection.hpp"
#include "framework/core/term.hpp"

namespace tack {

/// Base of energies, which implement make_term().
class Energy : public Component {
 public:
  static constexpr const char* kind_name = "energy";
  static constexpr const char* kind_doc = "A potential energy of an object, with its material.";

  /// Derived classes append their fields to these.
  void fields(Fields& f) override;
  /// Selection of the elements that the energy acts on, by their vertices (selected_elements.hpp);
  /// null: all.
  const Selection* selection() const { return select_.get(); }

  /// Makes the term. rest: rest configuration of all vertices (3n) [m]. Throws InputError if the
  /// body lacks the elements that the energy needs. Null: the energy only adds mass.
  virtual std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const = 0;
  /// Returns true if the term on tetrahedra depends on their kind (Body::elements).
  virtual bool takes_elements() const { return false; }
  /// Returns true if the energy needs twists of edges (Body::rod).
  virtual bool twists() const { return false; }
  /// Adds the body's lumped mass [kg] per vertex.
  virtual void add_mass(const Body& /*body*/, const VecX& /*rest*/, VecX& /*mass*/) const {}
  /// Young's modulus that scales adhesion and barrier [Pa].
  virtual std::optional<double> young() const { return std::nullopt; }
  /// Poisson's ratio of a solid [1].
  virtual std::optional<double> poisson() const { return std::nullopt; }
  /// Shear modulus of small strains of a solid or a membrane [Pa]. Branches that relax beside it
  /// are fractions of it.
  virtual std::optional<double> shear() const { return std::nullopt; }
  /// Returns true if the term reads Body::environment.
  virtual bool depends_on_temperature() const { return false; }
  /// Bending stiffness of a sheet or rod per width [N m]; 0 if it does not resist bending.
  virtual double bending_stiffness(const Body& /*body*/) const { return 0; }

 private:
  std::unique_ptr<Selection> select_;
};

}  // namespace tack
