// Elements for fibre_term.hpp, pack_width side by side: tets, composite tets and triangles of
// sheets. Each kind has
//   nodes, dim, samples     of an element; dim: 3 in solids, 2 in sheets
//   int count() const;
//   const int* vertices() const;                                    nodes of each element
//   PackMatrix<3, nodes> at(int first, int n, const VecX& x) const;  relative to the first node
//   PackMatrix<dim, nodes> gradients(int pack, int k) const;         columns: grad N_a [1/m]
//   Pack volume(int pack) const;                                     of a sample [m^3]
//   Vec3 centre(int element) const;                                  at rest [m]
//   Eigen::Matrix<double, dim, 1> along(int element, const Vec3& d) const;  components of d
#pragma once

#include "energies/shell/sheet_geometry.hpp"
#include "energies/solid/composite_tets.hpp"

namespace tack {

class FibreTets {
 public:
  static constexpr int nodes = 4, dim = 3, samples = 1;

  FibreTets(const Body& body, const VecX& rest)
      : tets_(body.tets), rest_(tet_rest_data(body, rest)), start_(rest) {}

  int count() const { return static_cast<int>(tets_.size()); }
  const int* vertices() const { return tets_.empty() ? nullptr : tets_.front().data(); }
  PackMatrix<3, nodes> at(int first, int n, const VecX& x) const {
    PackMatrix<3, nodes> out;
    for (int l = 0; l < pack_width; ++l) {
      const Tet& tet = tets_[first + std::min(l, n - 1)];
      for (int a = 0; a < nodes; ++a)
        for (int d = 0; d < 3; ++d) out(d, a).set(l, x[3 * tet[a] + d] - x[3 * tet[0] + d]);
    }
    return out;
  }
  PackMatrix<dim, nodes> gradients(int pack, int) const {
    PackMatrix<dim, nodes> out;
    for (int l = 0; l < pack_width; ++l) {
      const Mat3& shape = rest_[element(pack, l)].shape;
      for (int a = 1; a < nodes; ++a)
        for (int d = 0; d < dim; ++d) out(d, a).set(l, shape(a - 1, d));
    }
    out.col(0) = -(out.col(1) + out.col(2) + out.col(3));
    return out;
  }
  Pack volume(int pack) const {
    Pack out;
    for (int l = 0; l < pack_width; ++l) out.set(l, rest_[element(pack, l)].volume);
    return out;
  }
  Vec3 centre(int t) const {
    Vec3 sum = Vec3::Zero();
    for (const int v : tets_[t]) sum += vertex(start_, v);
    return sum / 4;
  }
  Vec3 along(int, const Vec3& d) const { return d; }

 private:
  int element(int pack, int lane) const { return std::min(pack * pack_width + lane, count() - 1); }

  std::vector<Tet> tets_;
  std::vector<TetRest<double>> rest_;
  VecX start_;
};

class FibreComposites {
 public:
  static constexpr int nodes = composite_nodes, dim = 3, samples = composite_points;

  FibreComposites(const Body& body, const VecX& rest) : tets_(body, rest), start_(rest) {}

  const CompositeTets& tets() const { return tets_; }
  int count() const { return tets_.count(); }
  const int* vertices() const { return count() == 0 ? nullptr : tets_.nodes().front().data(); }
  PackMatrix<3, nodes> at(int first, int n, const VecX& x) const { return tets_.at(first, n, x); }
  PackMatrix<dim, nodes> gradients(int pack, int k) const {
    const PackMat3& shape = tets_.shape(pack, k);
    PackMatrix<dim, nodes> out;
    for (int a = 0; a < nodes; ++a) {
      const CompositeTable::Row& c = composite_table().point[k][a];
      out.col(a) = shape.transpose() * PackVec3(c[0], c[1], c[2]);
    }
    return out;
  }
  Pack volume(int pack) const { return tets_.volume(pack) / samples; }
  Vec3 centre(int t) const {
    Vec3 sum = Vec3::Zero();
    for (int a = 0; a < 4; ++a) sum += vertex(start_, tets_.nodes()[t][a]);
    return sum / 4;
  }
  Vec3 along(int, const Vec3& d) const { return d; }

 private:
  CompositeTets tets_;
  VecX start_;
};

class FibreTriangles {
 public:
  static constexpr int nodes = 3, dim = 2, samples = 1;

  FibreTriangles(const Body& body, const VecX& rest)
      : triangles_(body.sheet), rest_(sheet_rest_data(body, rest)), start_(rest) {}

  int count() const { return static_cast<int>(triangles_.size()); }
  const int* vertices() const { return triangles_.front().data(); }
  PackMatrix<3, nodes> at(int first, int n, const VecX& x) const {
    PackMatrix<3, nodes> out;
    for (int l = 0; l < pack_width; ++l) {
      const Triangle& t = triangles_[first + std::min(l, n - 1)];
      for (int a = 0; a < nodes; ++a)
        for (int d = 0; d < 3; ++d) out(d, a).set(l, x[3 * t[a] + d] - x[3 * t[0] + d]);
    }
    return out;
  }
  PackMatrix<dim, nodes> gradients(int pack, int) const {
    PackMatrix<dim, nodes> out;
    for (int l = 0; l < pack_width; ++l) {
      const Mat2& shape = rest_[element(pack, l)].shape;
      for (int a = 1; a < nodes; ++a)
        for (int d = 0; d < dim; ++d) out(d, a).set(l, shape(a - 1, d));
    }
    out.col(0) = -(out.col(1) + out.col(2));
    return out;
  }
  Pack volume(int pack) const {
    Pack out;
    for (int l = 0; l < pack_width; ++l) out.set(l, rest_[element(pack, l)].volume);
    return out;
  }
  Vec3 centre(int t) const {
    Vec3 sum = Vec3::Zero();
    for (const int v : triangles_[t]) sum += vertex(start_, v);
    return sum / 3;
  }
  Vec2 along(int t, const Vec3& d) const {
    return sheet_frame(triangles_[t], start_).transpose() * d;
  }

 private:
  int element(int pack, int lane) const { return std::min(pack * pack_width + lane, count() - 1); }

  std::vector<Triangle> triangles_;
  std::vector<SheetRest<double>> rest_;
  VecX start_;
};

}  // namespace tack
