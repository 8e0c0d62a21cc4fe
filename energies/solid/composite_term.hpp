// Solids of composite tets (geometry/tets/divide_tets.hpp), for a splittable material
// (material_split.hpp). With the samples of composite_samples.hpp, a tet of volume V has the energy
//     (1 - b) V/4 sum over points of psi_s(F_q) + b V/8 sum over parts of psi_b(F_s) + V U(J),
//     J = 1/4 sum over points of det F_q.
// The mean J does not lock. The small fraction b of the parts prevents their inversion: energies of
// points alone permit it, and steps that a filter then truncates stall. The Hessian of U beyond the
// Hessians of the points is of rank one.
// If the material differs between samples, `shape.at(i)` and `part.at(i)` belong to sample i % 12
// of the tets from pack_width * (i / 12) on. Sources: composite_samples.hpp; Simo, Taylor, Pister
// 1985 for the mean volume.
#pragma once

#include <algorithm>
#include <limits>

#include "energies/solid/composite_sums.hpp"
#include "energies/solid/composite_tets.hpp"
#include "energies/solid/svd3.hpp"
#include "framework/core/records.hpp"
#include "framework/core/term.hpp"
#include "geometry/parallel.hpp"

namespace tack {

template <class Material>
class CompositeTerm : public Term, public StencilRanges {
 public:
  CompositeTerm(std::string name, const Material& material, const Body& body, const VecX& rest)
      : Term(std::move(name)), split_(material.split()), tets_(body, rest) {}

  double value(const VecX& x) const override {
    return sum_chunks(count(), [&](int first, int last) {
      double sum = 0;
      for (int t = first; t < last; t += pack_width) {
        const int pack = t / pack_width, n = std::min(pack_width, last - t);
        const Pack energy = tets_.volume(pack) * density(pack, tets_.at(t, n, x));
        for (int l = 0; l < n; ++l) sum += energy[l];
      }
      return sum;
    });
  }

  std::vector<StencilBatch> batches() const override {
    return {{composite_nodes, count(), count() == 0 ? nullptr : tets_.nodes().front().data()}};
  }

  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override {
    for_each_chunk(count(), [&](int, int first, int last) {
      range_derivatives(
          x, projection, first, last,
          gradient + CompositeSums::gradient_size * static_cast<size_t>(first),
          hessian ? hessian + CompositeSums::hessian_size * static_cast<size_t>(first) : nullptr);
    });
  }

  std::vector<const StencilRanges*> ranges() const override { return {this}; }

  void range_derivatives(const VecX& x, Projection projection, int first, int last,
                         double* gradient, double* hessian) const override {
    for (int t = first; t < last;
         t += pack_width, gradient += CompositeSums::gradient_size * pack_width) {
      elements(t, std::min(pack_width, last - t), x, projection, gradient, hessian);
      if (hessian) hessian += CompositeSums::hessian_size * pack_width;
    }
  }

  void publish(Records& records) const override {
    Term::publish(records);
    StressRecord stress{[this](const VecX& x) { return cauchy_stress(x); }};
    stress.tets = &tets_.parts();
    records.add(std::move(stress));
  }

  // Returns the stresses of the parts: a part at a corner has the stress of its point, an inner
  // part the mean of the four. The pressure of U is equal in all parts.
  virtual std::vector<Mat3> cauchy_stress(const VecX& x) const {
    std::vector<Mat3> stress(tets_.parts().size());
    for_each(
        tets_.packs(),
        [&](int p) {
          const int first = p * pack_width, n = std::min(pack_width, count() - first);
          const CompositePoints points = tets_.points(p, tets_.at(first, n, x));
          const Pack pressure = split_.volume.at(points.growth).pressure;
          std::array<PackMat3, composite_points> sigma;
          PackMat3 mean = PackMat3::Zero();
          for (int q = 0; q < composite_points; ++q) {
            const Svd3<Pack> svd = svd3(points.f[q]);
            const PackVec3 tau =
                material(split_.shape, p, q).derivatives(svd.s).gradient.cwiseProduct(svd.s);
            PackVec3 principal = tau / svd.s.prod();
            for (int i = 0; i < 3; ++i) principal(i) += pressure;
            sigma[q] = svd.u * principal.asDiagonal() * svd.u.transpose();
            mean += Pack(0.25) * sigma[q];
          }
          for (int l = 0; l < n; ++l)
            for (int s = 0; s < composite_parts; ++s)
              stress[composite_parts * (first + l) + s] =
                  get_lane<3, 3>(s < composite_points ? sigma[s] : mean, l);
        },
        chunk_size / pack_width);
    return stress;
  }

 protected:
  int count() const { return tets_.count(); }

  decltype(std::declval<const Material&>().split()) split_;
  CompositeTets tets_;

 private:
  static_assert(chunk_size % pack_width == 0 && grain % pack_width == 0);

  template <class M>
  static decltype(auto) material(const M& of, int pack, int k) {
    if constexpr (requires { of.at(0); }) return of.at(composite_samples * pack + k);
    else return (of);
  }

  Pack density(int pack, const CompositeNodes& x) const {
    const CompositePoints points = tets_.points(pack, x);
    Pack sum = split_.volume.at(points.growth).energy, least = 1 + points.growth;
    const auto add = [&](int k, const PackMat3& f, const auto& lanes) {
      sum += CompositeTets::weight(k) * lanes.energy(f);
      const Pack j = f.determinant();
      least = select(j < least, j, least);
    };
    for (int q = 0; q < composite_points; ++q) add(q, points.f[q], material(split_.shape, pack, q));
    for (int s = 0; s < composite_parts; ++s)
      add(composite_points + s, tets_.part(pack, s, x),
          material(split_.part, pack, composite_points + s));
    return select(least > 0, sum, std::numeric_limits<double>::infinity());
  }

  void elements(int first, int n, const VecX& x, Projection projection, double* gradient,
                double* hessian) const {
    const int pack = first / pack_width;
    const CompositeNodes at = tets_.at(first, n, x);
    const CompositePoints points = tets_.points(pack, at);
    const VolumeSample<Pack> volume = split_.volume.at(points.growth);
    CompositeSums sums(tets_, pack, projection, hessian != nullptr);
    for (int q = 0; q < composite_points; ++q) {
      const Svd3<Pack> svd = svd3(points.f[q]);
      sums.add_point(q, svd, material(split_.shape, pack, q).derivatives(svd.s), volume.pressure);
    }
    for (int s = 0; s < composite_parts; ++s) {
      const Svd3<Pack> svd = svd3(tets_.part(pack, s, at));
      sums.add_part(s, svd, material(split_.part, pack, composite_points + s).derivatives(svd.s));
    }
    sums.store(volume.bulk, n, gradient, hessian);
  }
};

}  // namespace tack
