// The term of a Maxwell branch (maxwell.hpp), for every kind of element. Base: the elastic term of
// its spring. The history of the branch multiplies the rest shapes of Base by F_v^-1, and the
// potential by the factor a of the step: the material if all elements have the same, else the
// volumes. A class derived from RelaxingTerm has
//   void apply_history();                          changes material and rest shapes
//   int samples() const;                           that have a history: elements or points
//   Strain strain(int i, const VecX& x) const;     of sample i, what decays of it
//   double volume_of(int i) const;                 of sample i at rest [m^3]
// and calls load_history({}) when it is constructed.
#pragma once

#include <utility>

#include "energies/viscoelastic/shifted_times.hpp"
#include "energies/viscoelastic/viscous_history.hpp"
#include "framework/core/records.hpp"

namespace tack {

// Publishes the dissipation of a step to x.
void publish_relaxation(Records& records, const std::string& term,
                        std::function<double(const VecX& x)> dissipated);

template <class Derived, class Base, int N>
class RelaxingTerm : public Base {
 public:
  using Strain = typename Relaxation<N>::Strain;

  template <class... Args>
  RelaxingTerm(ViscousHistory<N> history, ShiftedTimes times, Args&&... args)
      : Base(std::forward<Args>(args)...), history_(std::move(history)), times_(std::move(times)) {}

  void load_history(const History& history) override {
    history_.load_history(history, self().samples());
    self().apply_history();
  }
  void begin_step(const StepStart& start) override {
    if (history_.rewind()) self().apply_history();
    if (start.h == 0) return;
    // The temperature in the middle of the step: of second order.
    history_.begin_step(start.h, times_.at(start.time + start.h / 2),
                        [&](int i) { return self().strain(i, start.x); });
    self().apply_history();
  }
  void commit(const VecX& x, History& history) const override {
    history_.commit([&](int i) { return self().strain(i, x); }, history);
  }
  void publish(Records& records) const override {
    Base::publish(records);
    publish_relaxation(records, this->name(), [this](const VecX& x) { return dissipated(x); });
  }
  // Returns the dissipation of a step to x [J].
  double dissipated(const VecX& x) const {
    return history_.dissipated([&](int i) { return self().strain(i, x); },
                               [&](int i) { return self().volume_of(i); });
  }

 protected:
  // Returns Cauchy's stress of each sample, given that of Base. Kirchhoff's is that of Base per
  // det F_e; Cauchy's is per det F.
  std::vector<Mat3> per_deformed_volume(std::vector<Mat3> stress) const {
    for (int i = 0; i < static_cast<int>(stress.size()); ++i)
      stress[i] *= history_.inverse(i).determinant() * volume_factor(i);
    return stress;
  }
  // Return the factors of the material and of the volume of sample i, whose product is a.
  double material_factor() const { return history_.uniform() ? history_.end_factor(0) : 1; }
  double volume_factor(int i) const { return history_.uniform() ? 1 : history_.end_factor(i); }

  ViscousHistory<N> history_;

 private:
  Derived& self() { return static_cast<Derived&>(*this); }
  const Derived& self() const { return static_cast<const Derived&>(*this); }

  ShiftedTimes times_;
};

}  // namespace tack
