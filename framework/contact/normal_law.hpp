// A normal law: energy per area phi(d) [J/m^2] as a function of the true gap d [m]. Barriers and
// adhesion are normal laws; the laws of a pair of materials are summed before anything else happens.
//
// To add one, derive from NormalLawOf<MyLaw, AdhesionLaw> (or BarrierLaw), give the parameters in
// fields(), the range, and the formula once:
//     template <class T> T energy(const T& d) const;     // 0 < d < range()
// then TACK_REGISTER it in the same file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/assembly/dual2.hpp"
#include "framework/config/registry.hpp"

namespace tack {

struct LawSample {
  double value = 0;      // phi [J/m^2]
  double slope = 0;      // phi' [Pa]: positive pulls the sides together
  double curvature = 0;  // phi'' [Pa/m]
};

// What a law may know about the pair of objects that it is used for.
struct PairMaterials {
  double contact_distance = 0;  // dhat_b of the paper [m]
  double softer_young = 0;      // the smaller Young's modulus of the two sides [Pa]; 0 if neither has one
  double adhesion_peak = 0;     // peak traction of the pair's adhesion [Pa]; 0 without adhesion
  double softer_stiffness = 0;  // as softer_young, an affine body having a hundredth of its stiffness [Pa]; 0: as that
};

class NormalLaw : public Component {
 public:
  // Called once, before use: fills what is left to defaults. Throws InputError for a parameter that
  // does not go with the pair.
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

class BarrierLaw : public NormalLaw {
 public:
  static constexpr const char* kind_name = "barrier";
  static constexpr const char* kind_doc = "Repulsion that grows without bound as the gap closes.";
};

class AdhesionLaw : public NormalLaw {
 public:
  static constexpr const char* kind_name = "adhesion";
  static constexpr const char* kind_doc = "Attraction of two surfaces along the normal.";
  virtual double peak_traction() const = 0;     // max phi' [Pa]
  virtual double work_of_adhesion() const = 0;  // phi(inf) - phi(0) [J/m^2]
};

// Supplies the batched evaluation of a law from its one formula.
template <class Law, class Kind>
class NormalLawOf : public Kind {
 public:
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
