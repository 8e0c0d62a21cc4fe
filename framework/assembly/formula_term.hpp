// Term with one formula per stencil. Gradient, Hessian and projection follow from the formula:
//
//   struct Rope : FormulaOf<2> {
//     struct Data { double stiffness, length; };  // of a stencil: N/m, m
//     template <class T>
//     T energy(const Positions<T>& x, const Data& rope) const {  // J
//       const T stretch = (x[1] - x[0]).norm() - rope.length;
//       return stretch > 0 ? 0.5 * rope.stiffness * stretch * stretch : T(0);
//     }
//   };
//   auto term = std::make_unique<FormulaTerm<Rope>>("ropes");
//   term->add({v, w}, {100, 0.2});
//
// The energy must be invariant to a common translation of its positions. A formula relative to
// space uses a fixed vertex (InteractionBuilder::fixed). Cost: forward differentiation takes about
// (variables)^2 evaluations of the formula. It suits hundreds of stencils of any arity, or
// thousands of stencils of few vertices. Elements of a whole mesh have derivatives by hand.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "framework/assembly/dual_many.hpp"
#include "framework/assembly/stencil_clamp.hpp"
#include "framework/core/term.hpp"
#include "geometry/parallel.hpp"

namespace tack {

/// Arity: vertices of a stencil. The last `Scalars` of them are scalar dofs (world/unknowns.hpp):
/// x[k].x() is the displacement of scalar k [m].
template <int Arity, int Scalars = 0>
struct FormulaOf {
  static_assert(Arity >= 1 && Arity <= largest_arity,
                "core/term.hpp says how many vertices a stencil may have");
  static_assert(Scalars >= 0 && Scalars <= Arity);
  static constexpr int arity = Arity, scalars = Scalars;
  static constexpr bool stored = true;  // redefine as false for dissipation
  template <class T>
  using Positions = std::array<Eigen::Matrix<T, 3, 1>, Arity>;
};

/// A term that evaluates a formula for each stencil.
template <class Formula>
class FormulaTerm : public Term {
 public:
  static constexpr int arity = Formula::arity, scalars = Formula::scalars;
  using Data = typename Formula::Data;

  /// name: of the energy in results.
  explicit FormulaTerm(std::string name, Formula formula = {})
      : Term(std::move(name)), formula_(std::move(formula)) {}

  void add(const std::array<int, arity>& vertices, Data data) {
    for (const int v : vertices) vertices_.push_back(v);
    data_.push_back(std::move(data));
  }
  int count() const { return static_cast<int>(data_.size()); }
  std::array<int, arity> stencil(int s) const {
    std::array<int, arity> all;
    std::copy_n(vertices_.begin() + s * arity, arity, all.begin());
    return all;
  }
  const std::vector<Data>& data() const { return data_; }
  /// Data of the stencils. They may change only in begin_step, lag and remember
  /// (step_participant.hpp).
  std::vector<Data>& data() { return data_; }
  const Formula& formula() const { return formula_; }
  double energy(int s, const VecX& x) const { return energy(s, x, data_[s]); }  // J
  double energy(int s, const VecX& x, const Data& data) const {
    return formula_.energy(positions<double>(s, x, [](double value, int) { return value; }), data);
  }

  bool stores() const override { return Formula::stored; }
  double value(const VecX& x) const override {
    return sum_chunks(count(), [&](int first, int last) {
      double sum = 0;
      for (int s = first; s < last; ++s) sum += energy(s, x);
      return sum;
    });
  }
  std::vector<StencilBatch> batches() const override { return {batch()}; }
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override {
    for_each(
        count(),
        [&](int s) {
          double* const slopes = gradient + 3 * arity * static_cast<size_t>(s);
          if (!hessian) return write<Dual<false>>(s, x, slopes, nullptr);
          double* const curvatures = hessian + 9 * hessian_blocks(arity) * static_cast<size_t>(s);
          write<Dual<true>>(s, x, slopes, curvatures);
          project_slots(batch(), curvatures, projection);
        },
        16);
  }

 private:
  static constexpr int position_count = arity - scalars, variables = 3 * position_count + scalars;
  template <bool Curvature>
  using Dual = DualMany<variables, Curvature>;

  StencilBatch batch() const { return {arity, count(), vertices_.data(), scalars}; }

  // Returns the variable of a coordinate of a vertex; -1: none.
  static constexpr int variable(int k, int i) {
    return k < position_count ? 3 * k + i : i == 0 ? 3 * position_count + k - position_count : -1;
  }

  template <class T, class Make>
  typename Formula::template Positions<T> positions(int s, const VecX& x, const Make& make) const {
    typename Formula::template Positions<T> all;
    for (int k = 0; k < arity; ++k)
      for (int i = 0; i < 3; ++i) {
        const double value = x(3 * vertices_[static_cast<size_t>(s) * arity + k] + i);
        all[k](i) = variable(k, i) < 0 ? T(value) : make(value, variable(k, i));
      }
    return all;
  }

  template <class T>
  void write(int s, const VecX& x, double* gradient, double* hessian) const {
    const T energy = formula_.energy(
        positions<T>(s, x, [](double value, int i) { return T::variable(value, i); }), data_[s]);
    for (int k = 0; k < arity; ++k)
      for (int i = 0; i < 3; ++i) *gradient++ = variable(k, i) < 0 ? 0 : energy.d[variable(k, i)];
    if (!hessian) return;
    for (int k = 0; k < arity; ++k)
      for (int l = 0; l <= k; ++l)
        for (int j = 0; j < 3; ++j)
          for (int i = 0; i < 3; ++i) {
            const int a = std::max(variable(k, i), variable(l, j)),
                      b = std::min(variable(k, i), variable(l, j));
            *hessian++ = b < 0 ? 0 : energy.h[a * (a + 1) / 2 + b];
          }
  }

  Formula formula_;
  std::vector<int> vertices_;
  std::vector<Data> data_;
};

}  // namespace tack
