// sum over triangles of thickness * area * psi(F), for an isotropic material in plane stress, given
// in principal stretches, and fibres if there are any. A material has
//   Pack energy(const PlaneStrain& strain, const PackMat32& f) const;   psi [J/m^3]
//   PlaneDerivatives derivatives(const PackVec2& stretches) const;
// or, where it differs from triangle to triangle, at(p): that of the triangles pack_width * p on,
// one per lane. Triangles are computed pack_width at a time, one per lane, and projected in the
// principal frame.
//
// Fibres of stiffness E_f along d, in the plane of each triangle at rest, add
//   E_f/2 e^2,   e = (|F d|^2 - 1) / 2.
#pragma once

#include <algorithm>

#include "energies/shell/sheet_geometry.hpp"
#include "framework/core/records.hpp"
#include "framework/core/term.hpp"
#include "geometry/parallel.hpp"

namespace tack {

struct Fibres {
  double young = 0;  // E_f [Pa]
  std::vector<PackVec2> directions =
      {};  // of pack_width triangles each, in their frames; unit vectors. Empty: no fibres
};

template <class Material>
class MembraneTerm : public Term, public StencilRanges {
 public:
  MembraneTerm(std::string name, const Material& material, const Body& body, const VecX& rest,
               Fibres fibres = {})
      : Term(std::move(name)), material_(material), triangles_(body.sheet),
        rest_(packed(sheet_rest_data(body, rest))), fibres_(std::move(fibres)) {}

  double value(const VecX& x) const override {
    return sum_chunks(count(), [&](int first, int last) {
      double sum = 0;
      for (int t = first; t < last; t += pack_width) {
        const int p = t / pack_width, n = std::min(pack_width, last - t);
        const PackMat32 f = deformation_gradient(rest_[p], &triangles_[t], n, x);
        Pack psi = material(p).energy(plane_strain(f), f);
        if (!fibres_.directions.empty()) {
          const Pack e = ((f * fibres_.directions[p]).squaredNorm() - 1) / 2;
          psi += fibres_.young / 2 * e * e;
        }
        const Pack energy = rest_[p].volume * psi;
        for (int l = 0; l < n; ++l) sum += energy[l];
      }
      return sum;
    });
  }

  std::vector<StencilBatch> batches() const override {
    return {{3, count(), triangles_.front().data()}};
  }

  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override {
    for_each_chunk(count(), [&](int, int first, int last) {
      range_derivatives(x, projection, first, last, gradient + 9 * static_cast<size_t>(first),
                        hessian ? hessian + 54 * static_cast<size_t>(first) : nullptr);
    });
  }

  std::vector<const StencilRanges*> ranges() const override { return {this}; }

  void range_derivatives(const VecX& x, Projection projection, int first, int last,
                         double* gradient, double* hessian) const override {
    for (int t = first; t < last; t += pack_width, gradient += 9 * pack_width) {
      elements(t, std::min(pack_width, last - t), x, projection, gradient, hessian);
      if (hessian) hessian += 54 * pack_width;
    }
  }

  void publish(Records& records) const override {
    Term::publish(records);
    records.add(stress_record());
  }

  // Returns stresses without the elastic change of thickness and without fibres [Pa].
  std::vector<Mat3> cauchy_stress(const VecX& x) const {
    std::vector<Mat3> stress(triangles_.size());
    for_each(
        static_cast<int>(rest_.size()),
        [&](int p) {
          const int first = p * pack_width, n = std::min(pack_width, count() - first);
          const PlaneStretch stretch =
              plane_stretch(deformation_gradient(rest_[p], &triangles_[first], n, x));
          const PackVec2 principal =
              material(p).derivatives(stretch.s).gradient.cwiseProduct(stretch.s) /
              stretch.s.prod();
          PackMat3 sigma = stretch.u.template leftCols<2>() * principal.asDiagonal() *
                           stretch.u.template leftCols<2>().transpose();
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
  int count() const { return static_cast<int>(triangles_.size()); }

  // Returns the rest data of one triangle.
  SheetRest<double> rest_of(int t) const {
    const SheetRest<Pack>& pack = rest_[t / pack_width];
    return {get_lane<2, 2>(pack.shape, t % pack_width), pack.volume[t % pack_width]};
  }

  Material material_;
  std::vector<Triangle> triangles_;
  // Rest data of pack_width triangles each; the last lanes repeat the last triangle
  std::vector<SheetRest<Pack>> rest_;

 private:
  static_assert(chunk_size % pack_width == 0 && grain % pack_width == 0);

  decltype(auto) material(int pack) const {
    if constexpr (requires { material_.at(pack); }) return material_.at(pack);
    else return (material_);
  }

  static std::vector<SheetRest<Pack>> packed(const std::vector<SheetRest<double>>& rest) {
    const size_t packs = (rest.size() + pack_width - 1) / pack_width;
    std::vector<SheetRest<Pack>> out(packs);
    for (size_t t = 0; t < packs * pack_width; ++t) {
      const SheetRest<double>& triangle = rest[std::min(t, rest.size() - 1)];
      set_lane<2, 2>(out[t / pack_width].shape, t % pack_width, triangle.shape);
      out[t / pack_width].volume.set(t % pack_width, triangle.volume);
    }
    return out;
  }

  // Slots of the triangles first .. first + n.
  void elements(int first, int n, const VecX& x, Projection projection, double* gradient,
                double* hessian) const {
    const int p = first / pack_width;
    const SheetRest<Pack>& rest = rest_[p];
    const PackMat32 f = deformation_gradient(rest, &triangles_[first], n, x);
    const PlaneStretch stretch = plane_stretch(f);
    const PlaneDerivatives d = material(p).derivatives(stretch.s);
    const PackMat2 shape = rest.shape * stretch.v;  // row a-1: V^T grad N_a
    PackMat3 g;
    for (int a = 0; a < 2; ++a)
      g.col(a + 1) = rest.volume * (stretch.u.template leftCols<2>() *
                                    d.gradient.cwiseProduct(shape.row(a).transpose()));
    alignas(64) Pack slots[54];
    if (hessian)
      blocks(stretch.u, shape, plane_hessian(stretch.s, d, projection), rest.volume, slots);
    if (!fibres_.directions.empty())
      add_fibres(f, rest, fibres_.directions[p], projection, g, hessian ? slots : nullptr);
    g.col(0) = -(g.col(1) + g.col(2));
    store_lanes(g.data(), 9, gradient, n);
    if (!hessian) return;
    const auto slot = [&](int k) { return Eigen::Map<PackMat3>(slots + 9 * k); };
    // The rows and columns of vertex 0 make sums vanish.
    slot(1) = -(slot(2) + slot(4).transpose());
    slot(3) = -(slot(4) + slot(5));
    slot(0) = -(slot(1) + slot(3));
    store_lanes(slots, 54, hessian, n);
  }

  static constexpr int slot_of[3][3] = {{0, -1, -1}, {1, 2, -1}, {3, 4, 5}};

  // K_ab = volume U K^_ab U^T for a, b = 1, 2.
  static void blocks(const PackMat3& u, const PackMat2& shape, const PlaneHessian& h,
                     const Pack& volume, Pack* out) {
    for (int a = 0; a < 2; ++a) {
      const PackVec2 p = volume * shape.row(a).transpose();
      for (int b = 0; b <= a; ++b) {
        const PackVec2 q = shape.row(b).transpose();
        PackMat2 k;
        k(0, 0) = h.diagonal(0, 0) * p(0) * q(0) + h.same * p(1) * q(1);
        k(1, 1) = h.diagonal(1, 1) * p(1) * q(1) + h.same * p(0) * q(0);
        k(0, 1) = h.diagonal(0, 1) * p(0) * q(1) + h.cross * p(1) * q(0);
        k(1, 0) = h.diagonal(1, 0) * p(1) * q(0) + h.cross * p(0) * q(1);
        const Pack out_of_plane = h.out(0) * p(0) * q(0) + h.out(1) * p(1) * q(1);
        const PackMat32 half = u.template leftCols<2>() * k;
        Eigen::Map<PackMat3>(out + 9 * slot_of[a + 1][b + 1]).noalias() =
            half * u.template leftCols<2>().transpose() +
            out_of_plane * u.col(2) * u.col(2).transpose();
      }
    }
  }

  // With q = F d: gradient E_f e q (d . grad N_a), Hessian (d . grad N_a) (d . grad N_b) E_f (e I +
  // q q^T), whose eigenvalues are e + |q|^2 along q, and e across.
  void add_fibres(const PackMat32& f, const SheetRest<Pack>& rest, const PackVec2& direction,
                  Projection projection, PackMat3& g, Pack* slots) const {
    const PackVec3 q = f * direction;
    const PackVec2 along = rest.shape * direction;
    const Pack square = q.squaredNorm(), e = (square - 1) / 2,
               stiffness = rest.volume * fibres_.young;
    for (int a = 0; a < 2; ++a) g.col(a + 1) += (stiffness * e * along(a)) * q;
    if (!slots) return;
    const Pack across = projected(Pack(stiffness * e), projection);
    const Pack stretch = projected(Pack(stiffness * (e + square)), projection);
    PackMat3 k = ((stretch - across) / square) * q * q.transpose();
    for (int i = 0; i < 3; ++i) k(i, i) += across;
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b <= a; ++b)
        Eigen::Map<PackMat3>(slots + 9 * slot_of[a + 1][b + 1]) += (along(a) * along(b)) * k;
  }

  Fibres fibres_;
};

}  // namespace tack
