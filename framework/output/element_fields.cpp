#include "framework/output/element_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "framework/scene/world.hpp"

namespace tack {
namespace {

double von_mises(const Mat3& stress) {
  const Mat3 deviator = stress - stress.trace() / 3 * Mat3::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

// The cells of frames by their vertices: tets and triangles.
class Cells {
 public:
  explicit Cells(const FrameGeometry& geometry) {
    int cell = 0;
    for (const Tet& t : geometry.tets) cells_.emplace_back(key(t.data(), 4), cell++);
    for (const Triangle& t : geometry.triangles) cells_.emplace_back(key(t.data(), 3), cell++);
    std::sort(cells_.begin(), cells_.end());
  }

  // Of a stencil; -1 if it is none, as those of springs.
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

// Calls act(cell, number) for each of the numbers that a term has of its stencils.
template <class Number, class Act>
void for_each_cell(const Term& term, const std::vector<Number>& numbers, const Cells& cells, const Act& act) {
  const auto batches = term.batches();
  if (numbers.empty() || batches.size() != 1 || (batches[0].arity != 3 && batches[0].arity != 4)) return;
  const int arity = batches[0].arity;
  for (size_t s = 0; s < numbers.size(); ++s)
    if (const int cell = cells.find(batches[0].vertices + static_cast<size_t>(arity) * s, arity); cell >= 0) act(cell, numbers[s]);
}

VecX von_mises_stress(const World& world, const VecX& x, const Cells& cells, VecX values) {
  std::map<int, Mat3> sums;
  for (const auto& term : world.elastic_terms)
    for_each_cell(*term, term->cauchy_stress(x), cells, [&](int cell, const Mat3& stress) {
      sums.try_emplace(cell, Mat3::Zero()).first->second += stress;
    });
  for (const auto& [cell, stress] : sums) values(cell) = von_mises(stress);
  return values;
}

VecX plastic_strain(const World& world, const Cells& cells, VecX values) {
  for (const auto& term : world.elastic_terms)
    for_each_cell(*term, term->plastic_strain(), cells,
                  [&](int cell, double strain) { values(cell) = std::fmax(values(cell), strain); });
  return values;
}

}  // namespace

std::vector<CellField> element_fields(const std::vector<std::string>& names, const World& world, const VecX& x,
                                      const FrameGeometry& geometry) {
  const VecX none = VecX::Constant(geometry.cells(), std::numeric_limits<double>::quiet_NaN());
  std::vector<CellField> fields;
  std::optional<Cells> cells;
  for (const std::string& name : names) {
    const bool stress = name == "von_mises_stress", strain = name == "plastic_strain";
    if ((stress || strain) && !cells) cells.emplace(geometry);
    if (stress) fields.push_back({name, von_mises_stress(world, x, *cells, none), "Pa"});
    if (strain) fields.push_back({name, plastic_strain(world, *cells, none), ""});
  }
  return fields;
}

}  // namespace tack
