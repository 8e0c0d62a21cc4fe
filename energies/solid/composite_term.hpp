// Solids of composite tets (geometry/tets/divide_tets.hpp), for a material that can be split (material_split.hpp). With the samples of
// composite_samples.hpp, a tet of volume V costs
//     (1 - b) V/4 sum over points of psi_s(F_q) + b V/8 sum over parts of psi_b(F_s) + V U(J),   J = 1/4 sum over points of det F_q.
// The mean J does not lock; the small share b of the parts is what keeps them from inverting: energies of points alone let them, and steps that a
// filter then cuts stall. Of U'', what is not within the points' Hessians is of rank one.
// Where the material differs from sample to sample, `shape.at(i)` and `part.at(i)` are those of sample i % 12 of the tets pack_width * (i / 12) on.
// Sources: composite_samples.hpp; Simo, Taylor, Pister 1985 for the mean volume.
#pragma once

#include <algorithm>

#include "energies/solid/composite_samples.hpp"
#include "energies/solid/material_split.hpp"
#include "energies/solid/sample_stiffness.hpp"
#include "energies/solid/svd3.hpp"
#include "energies/solid/tet_geometry.hpp"
#include "framework/core/records.hpp"
#include "framework/core/term.hpp"
#include "geometry/parallel.hpp"

namespace tack {

template <class Material>
class CompositeTerm : public Term, public StencilRanges {
 public:
  // body.tets: eight for each, as divide_tets has left them.
  CompositeTerm(std::string name, const Material& material, const Body& body, const VecX& rest)
      : Term(std::move(name)), split_(material.split()), parts_(body.tets), tets_(composite_tets_of(body.tets)) {
    set_up(body, rest);
  }

  double value(const VecX& x) const override {
    return sum_chunks(count(), [&](int first, int last) {
      double sum = 0;
      for (int t = first; t < last; t += pack_width) {
        const int n = std::min(pack_width, last - t);
        const Pack energy = volume_[t / pack_width] * density(t / pack_width, nodes(t, n, x));
        for (int l = 0; l < n; ++l) sum += energy[l];
      }
      return sum;
    });
  }

  std::vector<StencilBatch> batches() const override {
    return {{composite_nodes, count(), tets_.empty() ? nullptr : tets_.front().data()}};
  }

  void derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const override {
    for_each_chunk(count(), [&](int, int first, int last) {
      range_derivatives(x, projection, first, last, gradient + gradient_size * static_cast<size_t>(first),
                        hessian ? hessian + hessian_size * static_cast<size_t>(first) : nullptr);
    });
  }

  std::vector<const StencilRanges*> ranges() const override { return {this}; }

  void range_derivatives(const VecX& x, Projection projection, int first, int last, double* gradient, double* hessian) const override {
    for (int t = first; t < last; t += pack_width, gradient += gradient_size * pack_width) {
      elements(t, std::min(pack_width, last - t), x, projection, gradient, hessian);
      if (hessian) hessian += hessian_size * pack_width;
    }
  }

  void publish(Records& records) const override {
    Term::publish(records);
    StressRecord stress{[this](const VecX& x) { return cauchy_stress(x); }};
    stress.tets = &parts_;
    records.add(std::move(stress));
  }

  // Of the parts: a corner has that of its own point, what is inside the mean of the four; the pressure of U is the same in all.
  std::vector<Mat3> cauchy_stress(const VecX& x) const {
    std::vector<Mat3> stress(parts_.size());
    for_each(packs(), [&](int p) {
      const int first = p * pack_width, n = std::min(pack_width, count() - first);
      const Nodes corners = nodes(first, n, x);
      const Points points(*this, p, corners);
      const Pack pressure = split_.volume.at(points.growth).pressure;
      std::array<PackMat3, composite_points> sigma;
      PackMat3 mean = PackMat3::Zero();
      for (int q = 0; q < composite_points; ++q) {
        const Svd3<Pack> svd = svd3(points.f[q]);
        const PackVec3 tau = material(split_.shape, p, q).derivatives(svd.s).gradient.cwiseProduct(svd.s);
        PackVec3 principal = tau / svd.s.prod();
        for (int i = 0; i < 3; ++i) principal(i) += pressure;
        sigma[q] = svd.u * principal.asDiagonal() * svd.u.transpose();
        mean += Pack(0.25) * sigma[q];
      }
      for (int l = 0; l < n; ++l)
        for (int s = 0; s < composite_parts; ++s)
          stress[composite_parts * (first + l) + s] = get_lane<3, 3>(s < composite_points ? sigma[s] : mean, l);
    }, chunk_size / pack_width);
    return stress;
  }

 protected:
  using Split = decltype(std::declval<const Material&>().split());
  using Nodes = PackMatrix<3, composite_nodes>;

  int count() const { return static_cast<int>(tets_.size()); }
  int packs() const { return static_cast<int>(shape_.size()); }

  // Of sample k: (grad N_1, grad N_2, grad N_3)^T of the corners, or that times what a material remembers.
  const PackMat3& shape(int pack, int k) const { return turned_.empty() ? shape_[pack] : turned_[composite_samples * pack + k]; }

  // The deformation gradient of one sample of one tet.
  Mat3 deformation(int t, int k, const VecX& x) const {
    Mat3 edges = Mat3::Zero();
    const Vec3 origin = vertex(x, tets_[t][0]);
    const auto add = [&](int node, const CompositeTable::Row& c) {
      edges += (vertex(x, tets_[t][node]) - origin) * Eigen::Map<const Vec3>(c.data()).transpose();
    };
    if (k < composite_points)
      for (int a = 0; a < composite_nodes; ++a) add(a, table_.point[k][a]);
    else
      for (int i = 0; i < 4; ++i) add(composite_tets[k - composite_points][i], table_.part[k - composite_points][i]);
    return edges * get_lane<3, 3>(shape(t / pack_width, k), t % pack_width);
  }
  double volume(int t) const { return volume_[t / pack_width][t % pack_width]; }
  // What of a tet's volume a sample's shape and part count for.
  static double weight(int k) { return k < composite_points ? (1 - share_of_parts) / composite_points : share_of_parts / composite_parts; }

  const CompositeTable& table_ = composite_table();
  Split split_;
  std::vector<Tet> parts_;
  std::vector<CompositeTet> tets_;
  std::vector<PackMat3> shape_, turned_;  // of pack_width tets each; the last lanes repeat the last tet. turned_: of each sample, or empty
  std::vector<Pack> volume_;              // likewise

 private:
  static constexpr size_t gradient_size = 3 * composite_nodes, hessian_size = 9 * hessian_blocks(composite_nodes);
  static_assert(chunk_size % pack_width == 0 && grain % pack_width == 0);

  void set_up(const Body& body, const VecX& rest) {
    const std::vector<TetRest<double>> of_parts = tet_rest_data(body, rest);  // refuses what is inverted
    const size_t all = (tets_.size() + pack_width - 1) / pack_width;
    shape_.resize(all);
    volume_.resize(all);
    for (size_t i = 0; i < all * pack_width; ++i) {
      const size_t t = std::min(i, tets_.size() - 1);
      const Tet corners{tets_[t][0], tets_[t][1], tets_[t][2], tets_[t][3]};
      double volume = 0;
      for (int s = 0; s < composite_parts; ++s) volume += of_parts[composite_parts * t + s].volume;
      set_lane<3, 3>(shape_[i / pack_width], static_cast<int>(i % pack_width), edges_of(corners, rest).inverse());
      volume_[i / pack_width].set(static_cast<int>(i % pack_width), volume);
    }
  }

  template <class M>
  static decltype(auto) material(const M& of, int pack, int k) {
    if constexpr (requires { of.at(0); }) return of.at(composite_samples * pack + k);
    else return (of);
  }

  // Of pack_width tets, from their first nodes: exact differences, however far from the origin.
  Nodes nodes(int first, int n, const VecX& x) const {
    Nodes out;
    for (int l = 0; l < pack_width; ++l) {
      const CompositeTet& tet = tets_[first + (l < n ? l : n - 1)];
      for (int a = 0; a < composite_nodes; ++a)
        for (int d = 0; d < 3; ++d) out(d, a).set(l, x[3 * tet[a] + d] - x[3 * tet[0] + d]);
    }
    return out;
  }

  // x c^T of a node, added up.
  static void add_outer(const Nodes& x, int node, const CompositeTable::Row& c, PackMat3& sum) {
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) sum(i, j) += c[j] * x(i, node);
  }
  static PackVec3 combined(const PackMat3& m, const CompositeTable::Row& c) {
    return Pack(c[0]) * m.col(0) + Pack(c[1]) * m.col(1) + Pack(c[2]) * m.col(2);
  }

  // The points of pack_width tets.
  struct Points {
    Points(const CompositeTerm& term, int pack, const Nodes& x) {
      for (int q = 0; q < composite_points; ++q) {
        PackMat3 edges = PackMat3::Zero();
        for (int a = 0; a < composite_nodes; ++a) add_outer(x, a, term.table_.point[q][a], edges);
        f[q] = edges * term.shape(pack, q);
        growth += 0.25 * volume_growth(f[q]);
      }
    }
    std::array<PackMat3, composite_points> f;
    Pack growth = 0;  // mean J - 1
  };

  PackMat3 part(int pack, int s, const Nodes& x) const {
    PackMat3 edges = PackMat3::Zero();
    for (int i = 0; i < 4; ++i) add_outer(x, composite_tets[s][i], table_.part[s][i], edges);
    return edges * shape(pack, composite_points + s);
  }

  Pack density(int pack, const Nodes& x) const {
    const Points points(*this, pack, x);
    Pack sum = split_.volume.at(points.growth).energy, least = 1 + points.growth;
    for (int q = 0; q < composite_points; ++q) {
      sum += weight(q) * material(split_.shape, pack, q).energy(points.f[q]);
      const Pack j = points.f[q].determinant();
      least = select(j < least, j, least);
    }
    for (int s = 0; s < composite_parts; ++s) {
      const PackMat3 f = part(pack, s, x);
      sum += weight(composite_points + s) * material(split_.part, pack, composite_points + s).energy(f);
      const Pack j = f.determinant();
      least = select(j < least, j, least);
    }
    return select(least > 0, sum, std::numeric_limits<double>::infinity());
  }

  static Eigen::Map<PackMat3> slot(Pack* slots, int a, int b) { return Eigen::Map<PackMat3>(slots + 9 * (a * (a + 1) / 2 + b)); }

  void elements(int first, int n, const VecX& x, Projection projection, double* gradient, double* hessian) const {
    const int pack = first / pack_width;
    const Nodes at = nodes(first, n, x);
    const Pack& v = volume_[pack];
    Nodes g = Nodes::Zero();
    alignas(64) Pack slots[hessian_size];
    if (hessian) std::fill(slots, slots + hessian_size, Pack(0));
    add_points(pack, at, projection, g, hessian ? slots : nullptr);
    for (int s = 0; s < composite_parts; ++s) add_part(pack, s, at, projection, g, hessian ? slots : nullptr);
    for (int i = 0; i < 3 * composite_nodes; ++i) g(i) *= v;
    store_lanes(g.data(), gradient_size, gradient, n);
    if (!hessian) return;
    for (Pack& k : slots) k *= v;
    store_lanes(slots, hessian_size, hessian, n);
  }

  // Per volume.
  void add_points(int pack, const Nodes& x, Projection projection, Nodes& g, Pack* slots) const {
    const Points points(*this, pack, x);
    const VolumeSample<Pack> volume = split_.volume.at(points.growth);
    Nodes growth = Nodes::Zero();  // the derivative of the mean J
    for (int q = 0; q < composite_points; ++q) {
      const PackMat3& turned = shape(pack, q);
      const auto& c = table_.point[q];
      const Svd3<Pack> svd = svd3(points.f[q]);
      PrincipalDerivatives d = material(split_.shape, pack, q).derivatives(svd.s);
      for (int i = 0; i < 3; ++i) d.gradient(i) *= 1 - share_of_parts;
      for (int i = 0; i < 9; ++i) d.hessian(i) *= 1 - share_of_parts;
      add_pressure(d, svd.s, volume.pressure);
      const PackMat3 of_edges = Pack(0.25) * (svd.u * d.gradient.asDiagonal() * svd.v.transpose()) * turned.transpose();
      for (int a = 0; a < composite_nodes; ++a) g.col(a) += combined(of_edges, c[a]);
      if (!slots) continue;
      const PackVec3 cofactor(svd.s(1) * svd.s(2), svd.s(0) * svd.s(2), svd.s(0) * svd.s(1));
      const PackMat3 of_growth = Pack(0.25) * (svd.u * cofactor.asDiagonal() * svd.v.transpose()) * turned.transpose();
      for (int a = 0; a < composite_nodes; ++a) growth.col(a) += combined(of_growth, c[a]);
      const PrincipalHessian h = principal_hessian(svd.s, d, projection);
      SampleStiffness stiffness(svd.u, h);
      const PackMat3 principal = svd.v.transpose() * turned.transpose();
      Nodes p;
      for (int a = 0; a < composite_nodes; ++a) p.col(a) = combined(principal, c[a]);
      for (int b = 0; b < composite_nodes; ++b) {
        stiffness.set(Pack(0.25) * p.col(b));
        for (int a = b; a < composite_nodes; ++a) {
          auto block = slot(slots, a, b);
          stiffness.add_to(block, p.col(a));
        }
      }
    }
    if (!slots) return;
    const Pack bulk = projected(volume.bulk, projection);
    for (int a = 0; a < composite_nodes; ++a)
      for (int b = 0; b <= a; ++b) slot(slots, a, b) += (bulk * growth.col(a)) * growth.col(b).transpose();
  }

  void add_part(int pack, int s, const Nodes& x, Projection projection, Nodes& g, Pack* slots) const {
    const Pack share = weight(composite_points + s);
    const PackMat3& turned = shape(pack, composite_points + s);
    const auto& c = table_.part[s];
    const auto& corners = composite_tets[s];
    const Svd3<Pack> svd = svd3(part(pack, s, x));
    const PrincipalDerivatives d = material(split_.part, pack, composite_points + s).derivatives(svd.s);
    const PackMat3 of_edges = share * (svd.u * d.gradient.asDiagonal() * svd.v.transpose()) * turned.transpose();
    for (int i = 0; i < 4; ++i) g.col(corners[i]) += combined(of_edges, c[i]);
    if (!slots) return;
    const PrincipalHessian h = principal_hessian(svd.s, d, projection);
    SampleStiffness stiffness(svd.u, h);
    const PackMat3 principal = svd.v.transpose() * turned.transpose();
    std::array<PackVec3, 4> p;
    for (int i = 0; i < 4; ++i) p[i] = combined(principal, c[i]);
    for (int k = 0; k < 4; ++k) {
      stiffness.set(share * p[k]);
      for (int i = 0; i < 4; ++i) {
        if (corners[i] < corners[k]) continue;
        auto block = slot(slots, corners[i], corners[k]);
        stiffness.add_to(block, p[i]);
      }
    }
  }
};

}  // namespace tack
