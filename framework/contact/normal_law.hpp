// Normal law: energy per area phi(d) [J/m^2] as a function of the gap d [m]. Barriers and adhesion
// are normal laws. The laws of a pair of materials are summed first (pair_law.hpp).
//
// To add one, derive from NormalLawOf<MyLaw, NormalAdhesion> (or BarrierLaw), give the parameters
// in fields(), the range, and the formula once:
//     template <class T> T energy(const T& d) const;     // 0 < d < range()
// then TACK_REGISTER it in the same file, an adhesion as an AdhesionLaw.
#pragma once

#include <memory>
#include <string_view>

#include "framework/assembly/dual2.hpp"
#include "framework/contact/adhesion_law.hpp"

namespace tack {

struct LawSample {
  double value = 0;      // phi [J/m^2]
  double slope = 0;      // phi' [Pa]: positive pulls the sides together
  double curvature = 0;  // phi'' [Pa/m]
};

class NormalLaw {
 public:
  virtual ~NormalLaw() = default;
  virtual std::string_view name() const = 0;  // registered type

  // Sets the parameters that were left to defaults. Called once, before use. Throws InputError for
  // a parameter that does not fit the pair.
  virtual void prepare(const PairMaterials& materials) = 0;
  virtual double range() const = 0;  // phi = phi' = 0 at and beyond [m]

  // Adds phi and its derivatives at n gaps.
  virtual void add_samples(int n, const double* d, LawSample* out) const = 0;
  virtual void add_values(int n, const double* d, double* out) const = 0;
  virtual std::unique_ptr<NormalLaw> clone() const = 0;

  LawSample at(double d) const {
    LawSample sample;
    add_samples(1, &d, &sample);
    return sample;
  }
};

class BarrierLaw : public Component, public NormalLaw {
 public:
  static constexpr const char* kind_name = "barrier";
  static constexpr const char* kind_doc = "Repulsion that grows without bound as the gap closes.";
};

class NormalAdhesion : public AdhesionLaw, public NormalLaw {
 public:
  void prepare(const PairMaterials& materials) override = 0;
};

// Implements the batched evaluation of a law by its formula.
template <class Law, class Kind>
class NormalLawOf : public Kind {
 public:
  std::string_view name() const override { return this->type(); }
  void add_samples(int n, const double* d, LawSample* out) const override {
    const Law& law = static_cast<const Law&>(*this);
    const double end = law.range();
    for (int i = 0; i < n; ++i) {
      if (!(d[i] < end)) continue;
      const Dual2 e = law.energy(Dual2::variable(d[i]));
      out[i].value += e.v;
      out[i].slope += e.d1;
      out[i].curvature += e.d2;
    }
  }
  void add_values(int n, const double* d, double* out) const override {
    const Law& law = static_cast<const Law&>(*this);
    const double end = law.range();
    for (int i = 0; i < n; ++i)
      if (d[i] < end) out[i] += law.energy(d[i]);
  }
  std::unique_ptr<NormalLaw> clone() const override {
    return std::make_unique<Law>(static_cast<const Law&>(*this));
  }
};

}  // namespace tack
