// sum over tets of volume * psi(F), for an isotropic material given in principal stretches.
// A material has
//   Pack energy(const PackMat3& f) const;    psi [J/m^3], infinite unless det F > 0
//   PrincipalDerivatives derivatives(const PackVec3& stretches) const;
// or, where it differs from tet to tet, at(p): that of the tets pack_width * p on, one per lane.
// Tets are computed pack_width at a time, one per lane. The Hessian is projected in the principal
// frame, in closed form but for one 3x3 matrix.
#pragma once

#include <algorithm>

#include "energies/solid/principal.hpp"
#include "energies/solid/svd3.hpp"
#include "energies/solid/tet_geometry.hpp"
#include "framework/core/local_stencils.hpp"
#include "framework/core/records.hpp"
#include "framework/core/term.hpp"
#include "geometry/parallel.hpp"

namespace tack {

/// Elastic energy of linear tets of one material.
template <class Material>
class SolidTerm : public Term, public StencilRanges {
 public:
  SolidTerm(std::string name, const Material& material, const Body& body, const VecX& rest)
      : Term(std::move(name)), material_(material), tets_(body.tets),
        rest_(packed(tet_rest_data(body, rest))) {}

  double value(const VecX& x) const override {
    return sum_chunks(count(), [&](int first, int last) {
      double sum = 0;
      for (int t = first; t < last; t += pack_width) {
        const int n = std::min(pack_width, last - t);
        const TetRest<Pack>& rest = rest_[t / pack_width];
        const Pack energy =
            rest.volume *
            material(t / pack_width).energy(deformation_gradient(rest, &tets_[t], n, x));
        for (int l = 0; l < n; ++l) sum += energy[l];
      }
      return sum;
    });
  }

  std::vector<StencilBatch> batches() const override {
    return {{4, count(), tets_.empty() ? nullptr : tets_.front().data()}};
  }

  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override {
    for_each_chunk(count(), [&](int, int first, int last) {
      range_derivatives(x, projection, first, last, gradient + 12 * static_cast<size_t>(first),
                        hessian ? hessian + 90 * static_cast<size_t>(first) : nullptr);
    });
  }

  std::vector<const StencilRanges*> ranges() const override { return {this}; }

  void range_derivatives(const VecX& x, Projection projection, int first, int last,
                         double* gradient, double* hessian) const override {
    for (int t = first; t < last; t += pack_width, gradient += 12 * pack_width) {
      elements(material(t / pack_width), t, std::min(pack_width, last - t), x, projection, gradient,
               hessian);
      if (hessian) hessian += 90 * pack_width;
    }
  }

  std::unique_ptr<Term> restricted(const StencilChoice& choice) const override {
    if constexpr (requires { material_.at(0); }) return nullptr;  // materials go by packs
    else if (choice.stencils.size() != 1) return nullptr;         // another class adds stencils
    else return std::make_unique<SolidTerm>(*this, choice);
  }
  /// The chosen tets of a term, with local vertices.
  SolidTerm(const SolidTerm& whole, const StencilChoice& choice)
      : Term(whole.name()), material_(whole.material_) {
    std::vector<TetRest<double>> rest;
    for (const int t : choice.stencils[0]) {
      tets_.push_back(choice.local(whole.tets_[t]));
      rest.push_back(whole.rest_of(t));
    }
    rest_ = packed(rest);
  }

  void publish(Records& records) const override {
    Term::publish(records);
    records.add(stress_record());
  }

  std::vector<Mat3> cauchy_stress(const VecX& x) const {
    std::vector<Mat3> stress(tets_.size());
    for_each(
        count() / pack_width + 1,
        [&](int p) {
          const int first = p * pack_width, n = std::min(pack_width, count() - first);
          if (n <= 0) return;
          const Svd3<Pack> svd = svd3(deformation_gradient(rest_[p], &tets_[first], n, x));
          const PackVec3 principal =
              material(p).derivatives(svd.s).gradient.cwiseProduct(svd.s) / svd.s.prod();
          const PackMat3 sigma = svd.u * principal.asDiagonal() * svd.u.transpose();
          for (int l = 0; l < n; ++l) stress[first + l] = get_lane<3, 3>(sigma, l);
        },
        chunk_size / pack_width);
    return stress;
  }

 protected:
  // Returns the stresses that publish() adds to the records.
  virtual StressRecord stress_record() const {
    return StressRecord{[this](const VecX& x) { return cauchy_stress(x); }};
  }
  int count() const { return static_cast<int>(tets_.size()); }

  // Returns the rest data of one tet.
  TetRest<double> rest_of(int t) const {
    const TetRest<Pack>& pack = rest_[t / pack_width];
    return {get_lane<3, 3>(pack.shape, t % pack_width), pack.volume[t % pack_width]};
  }
  Mat3 deformation(int t, const VecX& x) const {
    return deformation_gradient(rest_of(t), tets_[t], x);
  }

  decltype(auto) material(int pack) const {
    if constexpr (requires { material_.at(pack); }) return material_.at(pack);
    else return (material_);
  }

  // Slots of the tets first .. first + n, with their derivatives in principal stretches.
  template <class Lanes>
  void elements(const Lanes& lanes, int first, int n, const VecX& x, Projection projection,
                double* gradient, double* hessian) const {
    const TetRest<Pack>& rest = rest_[first / pack_width];
    const Svd3<Pack> svd = svd3(deformation_gradient(rest, &tets_[first], n, x));
    const PrincipalDerivatives d = lanes.derivatives(svd.s);
    const PackMat3 shape = rest.shape * svd.v;  // row a-1: V^T grad N_a
    PackMatrix<3, 4> g;
    for (int a = 0; a < 3; ++a)
      g.col(a + 1) = rest.volume * (svd.u * d.gradient.cwiseProduct(shape.row(a).transpose()));
    g.col(0) = -(g.col(1) + g.col(2) + g.col(3));
    store_lanes(g.data(), 12, gradient, n);
    if (!hessian) return;
    alignas(64) Pack slots[90];
    blocks(svd.u, shape, principal_hessian(svd.s, d, projection), rest.volume, slots);
    store_lanes(slots, 90, hessian, n);
  }

  Material material_;
  std::vector<Tet> tets_;
  std::vector<TetRest<Pack>> rest_;  // of pack_width tets each; the last lanes repeat the last tet

 private:
  static_assert(chunk_size % pack_width == 0 && grain % pack_width == 0);

  static std::vector<TetRest<Pack>> packed(const std::vector<TetRest<double>>& rest) {
    const size_t packs = (rest.size() + pack_width - 1) / pack_width;
    std::vector<TetRest<Pack>> out(packs);
    for (size_t t = 0; t < packs * pack_width; ++t) {
      const TetRest<double>& tet = rest[std::min(t, rest.size() - 1)];
      TetRest<Pack>& pack = out[t / pack_width];
      set_lane<3, 3>(pack.shape, t % pack_width, tet.shape);
      pack.volume.set(t % pack_width, tet.volume);
    }
    return out;
  }

  // K_ab = volume U K^_ab U^T for a, b = 1..3; the rows and columns of vertex 0 make sums vanish.
  static void blocks(const PackMat3& u, const PackMat3& shape, const PrincipalHessian& h,
                     const Pack& volume, Pack* out) {
    const auto slot = [&](int k) { return Eigen::Map<PackMat3>(out + 9 * k); };
    constexpr int lower[3][3] = {{2, -1, -1}, {4, 5, -1}, {7, 8, 9}};
    for (int a = 0; a < 3; ++a) {
      const PackVec3 p = volume * shape.row(a).transpose();
      for (int b = 0; b <= a; ++b) {
        const PackMat3 half = u * local_block(p, shape.row(b).transpose(), h);
        slot(lower[a][b]).noalias() = half * u.transpose();
      }
    }
    slot(1) = -(slot(2) + slot(4).transpose() + slot(7).transpose());
    slot(3) = -(slot(4) + slot(5) + slot(8).transpose());
    slot(6) = -(slot(7) + slot(8) + slot(9));
    slot(0) = -(slot(1) + slot(3) + slot(6));
  }

  static PackMat3 local_block(const PackVec3& p, const PackVec3& q, const PrincipalHessian& h) {
    PackMat3 k;
    for (int i = 0; i < 3; ++i) {
      Pack sum = h.diagonal(i, i) * p(i) * q(i);
      for (int j = 0; j < 3; ++j) {
        if (i == j) continue;
        k(i, j) = h.diagonal(i, j) * p(i) * q(j) + h.cross(i, j) * p(j) * q(i);
        sum += h.same(i, j) * p(j) * q(j);
      }
      k(i, i) = sum;
    }
    return k;
  }
};

}  // namespace tack
