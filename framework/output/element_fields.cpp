#include "framework/output/element_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "framework/assembly/symmetric_eigen.hpp"
#include "framework/output/frame_fields.hpp"
#include "framework/world/world.hpp"

namespace tack {
namespace {

double von_mises(const Mat3& stress) {
  const Mat3 deviator = stress - stress.trace() / 3 * Mat3::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

// Index of the frames' cells (tetrahedra and triangles) by their vertices.
class CellIndex {
 public:
  explicit CellIndex(const FrameGeometry& geometry) {
    int cell = 0;
    for (const Tet& t : geometry.tets) cells_.emplace_back(key(t.data(), 4), cell++);
    for (const Triangle& t : geometry.triangles) cells_.emplace_back(key(t.data(), 3), cell++);
    std::sort(cells_.begin(), cells_.end());
  }

  // Returns the cell of a stencil; -1 for stencils that are no cells, such as springs.
  int find(const int* vertices, int arity) const {
    const Key wanted = key(vertices, arity);
    const auto at = std::lower_bound(cells_.begin(), cells_.end(), std::pair(wanted, 0));
    return at != cells_.end() && at->first == wanted ? at->second : -1;
  }

 private:
  using Key = std::array<int, 4>;
  static Key key(const int* vertices, int arity) {
    Key k{-1, -1, -1, -1};
    std::copy(vertices, vertices + arity, k.begin());
    std::sort(k.begin(), k.end());
    return k;
  }
  std::vector<std::pair<Key, int>> cells_;
};

// Returns the elements that a record's numbers belong to.
template <class Record>
StencilBatch elements_of(const Record& record) {
  if (record.tets) return {4, static_cast<int>(record.tets->size()), record.tets->empty() ? nullptr : record.tets->front().data()};
  const auto batches = record.term ? record.term->batches() : std::vector<StencilBatch>();
  return batches.size() == 1 ? batches[0] : StencilBatch();
}

// Calls act(cell, element) for each element that is a cell.
template <class Act>
void for_each_cell(const StencilBatch& elements, const CellIndex& cells, const Act& act) {
  if (elements.arity != 3 && elements.arity != 4) return;
  for (int s = 0; s < elements.count; ++s)
    if (const int cell = cells.find(elements.vertices + static_cast<size_t>(elements.arity) * s, elements.arity); cell >= 0) act(cell, s);
}

// Stresses by cell; not a number in cells that are no elements.
std::vector<Mat3> cauchy_stresses(const World& world, const VecX& x, const CellIndex& cells, int cell_count) {
  std::vector<Mat3> sums(cell_count, Mat3::Constant(std::numeric_limits<double>::quiet_NaN()));
  std::vector<char> found(cell_count, 0);
  for (const StressRecord& record : world.records.stresses()) {
    const std::vector<Mat3> stresses = record.values(x);
    for_each_cell(elements_of(record), cells, [&](int cell, int stencil) {
      if (!std::exchange(found[cell], 1)) sums[cell].setZero();
      sums[cell] += stresses[stencil];
    });
  }
  return sums;
}

VecX von_mises_stress(const std::vector<Mat3>& stresses) {
  VecX values(stresses.size());
  for (size_t c = 0; c < stresses.size(); ++c) values(c) = von_mises(stresses[c]);
  return values;
}

VecX cauchy_stress(const std::vector<Mat3>& stresses) {
  VecX values(6 * stresses.size());
  for (size_t c = 0; c < stresses.size(); ++c) {
    const Mat3& s = stresses[c];
    values.segment<6>(6 * c) << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2);
  }
  return values;
}

// Returns the singular values, largest first, of the map from K edge vectors at rest to the present
// ones.
template <int K>
std::array<double, K> stretches_of(const std::array<Vec3, K>& rest, const std::array<Vec3, K>& now) {
  // Gram-Schmidt: with the rest shape = Q R, now R^-1 is the deformation gradient in Q's axes.
  std::array<Vec3, K> q = rest;
  Mat3 f = Mat3::Zero();
  for (int k = 0; k < K; ++k) {
    f.col(k) = now[k];
    for (int j = 0; j < k; ++j) {
      const double r = q[j].dot(q[k]);
      q[k] -= r * q[j];
      f.col(k) -= r * f.col(j);
    }
    const double length = q[k].norm();
    q[k] /= length;
    f.col(k) /= length;
  }
  Vec3 squares = SymmetricEigen<3>(f.transpose() * f).values();
  std::sort(squares.data(), squares.data() + 3, std::greater<>());
  std::array<double, K> stretches;
  for (int k = 0; k < K; ++k) stretches[k] = std::sqrt(std::fmax(0, squares(k)));
  return stretches;
}

template <int K, class Element>
void add_stretches(const std::vector<Element>& elements, const VecX& rest, const VecX& x, int& cell, VecX& values) {
  for (const Element& e : elements) {
    std::array<Vec3, K> before, now;
    for (int k = 0; k < K; ++k) {
      before[k] = vertex(rest, e[k + 1]) - vertex(rest, e[0]);
      now[k] = vertex(x, e[k + 1]) - vertex(x, e[0]);
    }
    const std::array<double, K> found = stretches_of<K>(before, now);
    std::copy(found.begin(), found.end(), values.data() + 3 * cell++);
  }
}

VecX stretches(const World& world, const VecX& x, const FrameGeometry& geometry, VecX values) {
  int cell = 0;
  add_stretches<3>(geometry.tets, world.rest, x, cell, values);
  add_stretches<2>(geometry.triangles, world.rest, x, cell, values);
  add_stretches<1>(geometry.edges, world.rest, x, cell, values);
  return values;
}

// Returns fields that terms publish.
VecX published(const FrameFieldInfo& field, const World& world, const VecX& x, const CellIndex& cells, VecX all) {
  const int n = field.components;
  for (const FieldRecord& record : world.records.fields()) {
    if (record.name != field.name || !record.of_elements) continue;
    const VecX values = record.values(x);
    const StencilBatch elements = elements_of(record);
    if (elements.arity == 0 || values.size() != n * elements.count)
      throw std::logic_error("the field '" + field.name + "' has not " + std::to_string(n) + " numbers for each stencil of one batch of its term");
    for_each_cell(elements, cells, [&](int cell, int stencil) {
      for (int k = 0; k < n; ++k) record.combine(values(n * stencil + k), all(n * cell + k));
    });
  }
  return all;
}

}  // namespace

std::vector<CellField> element_fields(const std::vector<std::string>& names, const World& world, const VecX& x,
                                      const FrameGeometry& geometry) {
  const auto none = [&](int components) {
    return VecX::Constant(components * geometry.cells(), std::numeric_limits<double>::quiet_NaN());
  };
  const std::vector<FrameFieldInfo> known = frame_fields();
  std::vector<CellField> fields;
  std::optional<CellIndex> cells;
  std::optional<std::vector<Mat3>> stresses;
  for (const std::string& name : names) {
    const auto info = std::find_if(known.begin(), known.end(), [&](const FrameFieldInfo& f) { return f.name == name && f.of_elements; });
    if (info == known.end()) continue;
    if (name == "stretches") {
      fields.push_back({name, stretches(world, x, geometry, none(3)), info->unit, 3});
      continue;
    }
    if (!cells) cells.emplace(geometry);
    const bool mises = name == "von_mises_stress", cauchy = name == "cauchy_stress";
    if ((mises || cauchy) && !stresses) stresses = cauchy_stresses(world, x, *cells, geometry.cells());
    if (mises) fields.push_back({name, von_mises_stress(*stresses), info->unit});
    else if (cauchy) fields.push_back({name, cauchy_stress(*stresses), info->unit, 6});
    else fields.push_back({name, published(*info, world, x, *cells, none(info->components)), info->unit, info->components});
  }
  return fields;
}

}  // namespace tack
