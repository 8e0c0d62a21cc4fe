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

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "energies/shell/sheet_geometry.hpp"
#include "energies/solid/composite_tets.hpp"

namespace tack {

// Linear tets or triangles: a gradient for each. Element: their vertices; Rest: their rest shapes.
template <class Element, class Rest>
class FibreSimplices {
 public:
  static constexpr int nodes = static_cast<int>(std::tuple_size_v<Element>), dim = nodes - 1;
  static constexpr int samples = 1;

  FibreSimplices(std::vector<Element> elements, std::vector<Rest> shapes, const VecX& rest)
      : elements_(std::move(elements)), rest_(std::move(shapes)), start_(rest) {}

  int count() const { return static_cast<int>(elements_.size()); }
  const int* vertices() const { return elements_.empty() ? nullptr : elements_.front().data(); }
  PackMatrix<3, nodes> at(int first, int n, const VecX& x) const {
    PackMatrix<3, nodes> out;
    for (int l = 0; l < pack_width; ++l) {
      const Element& v = elements_[first + std::min(l, n - 1)];
      for (int a = 0; a < nodes; ++a)
        for (int d = 0; d < 3; ++d) out(d, a).set(l, x[3 * v[a] + d] - x[3 * v[0] + d]);
    }
    return out;
  }
  PackMatrix<dim, nodes> gradients(int pack, int) const {
    PackMatrix<dim, nodes> out;
    for (int l = 0; l < pack_width; ++l) {
      const auto& shape = rest_[element(pack, l)].shape;
      for (int a = 1; a < nodes; ++a)
        for (int d = 0; d < dim; ++d) out(d, a).set(l, shape(a - 1, d));
    }
    Eigen::Matrix<Pack, dim, 1> sum = out.col(1);
    for (int a = 2; a < nodes; ++a) sum += out.col(a);
    out.col(0) = -sum;
    return out;
  }
  Pack volume(int pack) const {
    Pack out;
    for (int l = 0; l < pack_width; ++l) out.set(l, rest_[element(pack, l)].volume);
    return out;
  }
  Vec3 centre(int e) const {
    Vec3 sum = Vec3::Zero();
    for (const int v : elements_[e]) sum += vertex(start_, v);
    return sum / nodes;
  }

 protected:
  const Element& vertices_of(int e) const { return elements_[e]; }
  const VecX& start() const { return start_; }

 private:
  int element(int pack, int lane) const { return std::min(pack * pack_width + lane, count() - 1); }

  std::vector<Element> elements_;
  std::vector<Rest> rest_;
  VecX start_;
};

class FibreTets : public FibreSimplices<Tet, TetRest<double>> {
 public:
  FibreTets(const Body& body, const VecX& rest)
      : FibreSimplices(body.tets, tet_rest_data(body, rest), rest) {}
  Vec3 along(int, const Vec3& d) const { return d; }
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

class FibreTriangles : public FibreSimplices<Triangle, SheetRest<double>> {
 public:
  FibreTriangles(const Body& body, const VecX& rest)
      : FibreSimplices(body.sheet, sheet_rest_data(body, rest), rest) {}
  Vec2 along(int t, const Vec3& d) const {
    return sheet_frame(vertices_of(t), start()).transpose() * d;
  }
};

}  // namespace tack
