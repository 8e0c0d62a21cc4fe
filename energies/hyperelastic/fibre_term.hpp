// sum over elements and their samples of volume * psi(F), for families of fibres (fibre_law.hpp).
// With p_a = H grad N_a and q = F, a sample has
//     gradient  2 psi' F p_a,
//     Hessian   4 psi'' (F p_a) (F p_b)^T + 2 psi' (grad N_a . p_b) I,
// which is positive semi-definite: projections change nothing. Elements: fibre_elements.hpp.
#pragma once

#include <algorithm>
#include <array>

#include "energies/hyperelastic/fibre_elements.hpp"
#include "energies/hyperelastic/fibre_law.hpp"
#include "framework/core/records.hpp"
#include "framework/core/term.hpp"
#include "geometry/parallel.hpp"

namespace tack {

template <class Elements>
class FibreTerm : public Term, public StencilRanges {
 public:
  static constexpr int nodes = Elements::nodes, dim = Elements::dim;
  using Direction = PackMatrix<dim>;

  // directions: of each family, of pack_width elements each; unit vectors.
  FibreTerm(std::string name, const FibreLaw& law, Elements elements,
            std::vector<std::vector<Direction>> directions)
      : Term(std::move(name)), law_(law), elements_(std::move(elements)),
        directions_(std::move(directions)) {}

  double value(const VecX& x) const override {
    return sum_chunks(count(), [&](int first, int last) {
      double sum = 0;
      for (int t = first; t < last; t += pack_width) {
        const int pack = t / pack_width, n = std::min(pack_width, last - t);
        const PackMatrix<3, nodes> at = elements_.at(t, n, x);
        Pack density = 0;
        for (int k = 0; k < Elements::samples; ++k) {
          const PackMatrix<3, dim> f = at.lazyProduct(elements_.gradients(pack, k).transpose());
          for (const auto& family : directions_) density += law_.energy(strain(f, family[pack]));
        }
        const Pack energy = elements_.volume(pack) * density;
        for (int l = 0; l < n; ++l) sum += energy[l];
      }
      return sum;
    });
  }

  std::vector<StencilBatch> batches() const override {
    return {{nodes, count(), elements_.vertices()}};
  }
  std::vector<const StencilRanges*> ranges() const override { return {this}; }

  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override {
    for_each_chunk(count(), [&](int, int first, int last) {
      range_derivatives(x, projection, first, last,
                        gradient + 3 * nodes * static_cast<size_t>(first),
                        hessian ? hessian + 9 * blocks * static_cast<size_t>(first) : nullptr);
    });
  }

  void range_derivatives(const VecX& x, Projection, int first, int last, double* gradient,
                         double* hessian) const override {
    for (int t = first; t < last; t += pack_width, gradient += 3 * nodes * pack_width) {
      write(t, std::min(pack_width, last - t), x, gradient, hessian);
      if (hessian) hessian += 9 * blocks * pack_width;
    }
  }

  void publish(Records& records) const override {
    Term::publish(records);
    StressRecord stress{[this](const VecX& x) { return cauchy_stress(x); }};
    if constexpr (requires { elements_.tets(); }) stress.tets = &elements_.tets().parts();
    records.add(std::move(stress));
  }

  // Returns stresses of elements; of the parts of composite tets, as CompositeTerm does; in sheets
  // without the elastic change of thickness [Pa].
  std::vector<Mat3> cauchy_stress(const VecX& x) const {
    std::vector<Mat3> all;
    for (int t = 0; t < count(); t += pack_width) {
      const int pack = t / pack_width, n = std::min(pack_width, count() - t);
      const PackMatrix<3, nodes> at = elements_.at(t, n, x);
      std::array<PackMat3, Elements::samples> sigma;
      PackMat3 mean = PackMat3::Zero();
      for (int k = 0; k < Elements::samples; ++k) {
        sigma[k] = stress(at.lazyProduct(elements_.gradients(pack, k).transpose()), pack);
        mean += Pack(1.0 / Elements::samples) * sigma[k];
      }
      constexpr int parts = Elements::samples == 1 ? 1 : composite_parts;
      for (int l = 0; l < n; ++l)
        for (int s = 0; s < parts; ++s)
          all.push_back(get_lane<3, 3>(s < Elements::samples ? sigma[s] : mean, l));
    }
    return all;
  }

 private:
  static constexpr int blocks = hessian_blocks(nodes);
  static_assert(chunk_size % pack_width == 0 && grain % pack_width == 0);

  int count() const { return elements_.count(); }

  // Returns H u.
  PackMatrix<dim> structured(const PackMatrix<dim>& u, const Direction& d) const {
    return Pack(law_.kappa) * u + ((1 - dim * law_.kappa) * d.dot(u)) * d;
  }
  Pack strain(const PackMatrix<3, dim>& f, const Direction& d) const {
    const PackVec3 along = f * d;
    Pack dispersed = 0;
    for (int i = 0; i < dim; ++i) dispersed += PackVec3(f.col(i)).squaredNorm() - 1;
    return law_.kappa * dispersed + (1 - dim * law_.kappa) * (along.squaredNorm() - 1);
  }

  // Slots of the elements first .. first + n.
  void write(int first, int n, const VecX& x, double* gradient, double* hessian) const {
    const int pack = first / pack_width;
    const PackMatrix<3, nodes> at = elements_.at(first, n, x);
    const Pack volume = elements_.volume(pack);
    PackMatrix<3, nodes> g = PackMatrix<3, nodes>::Zero();
    alignas(64) Pack slots[9 * blocks];
    if (hessian) std::fill(slots, slots + 9 * blocks, Pack(0));
    for (int k = 0; k < Elements::samples; ++k) {
      const PackMatrix<dim, nodes> shape = elements_.gradients(pack, k);
      const PackMatrix<3, dim> f = at.lazyProduct(shape.transpose());
      for (const auto& family : directions_) {
        const FibreLaw::Slopes psi = law_.slopes(strain(f, family[pack]));
        if (!any(psi.first > 0)) continue;
        PackMatrix<dim, nodes> p;
        PackMatrix<3, nodes> y;
        for (int a = 0; a < nodes; ++a) {
          p.col(a) = structured(shape.col(a), family[pack]);
          y.col(a) = f * p.col(a);
        }
        const Pack pull = 2 * volume * psi.first, stiff = 4 * volume * psi.second;
        g += pull * y;
        if (!hessian) continue;
        for (int a = 0; a < nodes; ++a)
          for (int b = 0; b <= a; ++b) {
            Eigen::Map<PackMat3> slot(slots + 9 * (a * (a + 1) / 2 + b));
            slot += (stiff * y.col(a)) * y.col(b).transpose();
            const Pack across = pull * shape.col(a).dot(p.col(b));
            for (int i = 0; i < 3; ++i) slot(i, i) += across;
          }
      }
    }
    store_lanes(g.data(), 3 * nodes, gradient, n);
    if (hessian) store_lanes(slots, 9 * blocks, hessian, n);
  }

  PackMat3 stress(const PackMatrix<3, dim>& f, int pack) const {
    PackMat3 sum = PackMat3::Zero();
    for (const auto& family : directions_) {
      const Pack pull = 2 * law_.slopes(strain(f, family[pack])).first;
      PackMatrix<3, dim> p;
      for (int i = 0; i < 3; ++i)
        p.row(i) = structured(f.row(i).transpose(), family[pack]).transpose();
      sum += pull * (p * f.transpose());
    }
    const PackMatrix<dim, dim> c = f.transpose() * f;
    return sum / sqrt(Pack(c.determinant()));
  }

  FibreLaw law_;
  Elements elements_;
  std::vector<std::vector<Direction>> directions_;
};

}  // namespace tack
