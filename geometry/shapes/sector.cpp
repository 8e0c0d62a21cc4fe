#include "geometry/shapes/sector.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/errors.hpp"
#include "geometry/shapes/prism.hpp"

namespace tack {
namespace {

constexpr int cell_count_max = 1'000'000;

class Builder {
 public:
  explicit Builder(const Sector& s) : s_(s) {
    for (size_t j = 0; j < s.depths.size(); ++j)
      for (size_t i = 0; i < s.radii.size(); ++i) add_vertices(i, j);
    for (size_t j = 0; j + 1 < s.depths.size(); ++j)
      for (size_t i = 0; i + 1 < s.radii.size(); ++i) add_cell(i, j);
  }
  Mesh take() { return std::move(mesh_); }

 private:
  // Returns the index of the vertex of ring i, layer j; on the axis both sides share it.
  int index(size_t i, size_t j, int side) const {
    const size_t per_layer = 2 * s_.radii.size() - 1;
    return static_cast<int>(j * per_layer + (i == 0 ? 0 : 2 * i - 1 + static_cast<size_t>(side)));
  }

  void add_vertices(size_t i, size_t j) {
    const double r = s_.radii[i], top = s_.crown > 0 ? r * r / (s_.crown + std::sqrt(s_.crown * s_.crown - r * r)) : 0;
    const double y = -top - s_.depths[j] * (1 - top / s_.depths.back());
    for (int side = 0; side < (i == 0 ? 1 : 2); ++side) {
      const double azimuth = (side - 0.5) * s_.angle;
      const int v = static_cast<int>(mesh_.vertices.size());
      mesh_.vertices.emplace_back(i == 0 ? 0 : r * std::cos(azimuth), y, i == 0 ? 0 : r * std::sin(azimuth));
      mesh_.tags[i == 0 ? "axis" : side == 0 ? "left" : "right"].push_back(v);
      if (j == 0) mesh_.tags["top"].push_back(v);
      if (j + 1 == s_.depths.size()) mesh_.tags["bottom"].push_back(v);
      if (i + 1 == s_.radii.size()) mesh_.tags["rim"].push_back(v);
    }
  }

  // Adds two triangles, with alternating diagonals, each of which makes a prism between the two sides. Prisms are divided by the
  // order of their vertices, so that neighbours conform.
  void add_cell(size_t i, size_t j) {
    using Corner = std::pair<size_t, size_t>;
    const Corner a{i, j}, b{i + 1, j}, c{i + 1, j + 1}, d{i, j + 1};
    const bool even = (i + j) % 2 == 0;
    for (std::array<Corner, 3> t : {even ? std::array{a, b, c} : std::array{a, b, d}, even ? std::array{a, c, d} : std::array{b, c, d}}) {
      std::sort(t.begin(), t.end());
      std::array<int, 3> l, r;
      for (int k = 0; k < 3; ++k) l[k] = index(t[k].first, t[k].second, 0), r[k] = index(t[k].first, t[k].second, 1);
      add_prism(mesh_, l, r);
    }
  }

  const Sector& s_;
  Mesh mesh_;
};

}  // namespace

std::vector<double> graded(const std::vector<Vec2>& cells) {
  if (cells.size() < 2 || cells.front().x() != 0) throw InputError("cells of a sector: expects positions and lengths there, [[0, 1 mm], [1 cm, 2 mm]], say, the first at 0");
  std::vector<double> positions = {0};
  for (size_t k = 0; k < cells.size(); ++k) {
    if (!(cells[k].y() > 0)) throw InputError(fmt::format("cells of a sector: the length {:g} m at {:g} m is not positive", cells[k].y(), cells[k].x()));
    if (k == 0) continue;
    const double from = cells[k - 1].x(), to = cells[k].x(), first = cells[k - 1].y(), last = cells[k].y(), length = to - from;
    if (!(length > 0)) throw InputError(fmt::format("cells of a sector: the position {:g} m is not above the previous one, {:g} m", to, from));
    // Lengths are linear in the position, so that positions are exponential in the cell index.
    const double growth = std::log(last / first), cell_count = std::abs(growth) < 1e-9 ? length / first : growth * length / (last - first);
    if (!(cell_count < cell_count_max)) throw InputError(fmt::format("cells of a sector: from {:g} to {:g} m there are more than {}", from, to, cell_count_max));
    const int count = std::max(1, static_cast<int>(std::ceil(cell_count - 1e-9)));
    for (int i = 1; i < count; ++i) {
      const double fraction = double(i) / count;
      positions.push_back(from + length * (std::abs(growth) < 1e-9 ? fraction : std::expm1(growth * fraction) / std::expm1(growth)));
    }
    positions.push_back(to);
  }
  return positions;
}

Mesh sector(const Sector& s) {
  if (!(s.angle > 0 && s.angle < std::numbers::pi / 2)) throw InputError(fmt::format("a sector of {:g} degrees: it takes more than 0 and less than 90", s.angle * 180 / std::numbers::pi));
  if (s.radii.size() < 2 || s.depths.size() < 2) throw InputError("a sector needs a cell along its radius, and one along its depth");
  if (s.crown != 0 && !(s.crown > s.radii.back())) throw InputError(fmt::format("a sector's crown of {:g} m has to be larger than its radius, {:g} m", s.crown, s.radii.back()));
  const double sag = s.crown > 0 ? s.crown - std::sqrt(s.crown * s.crown - s.radii.back() * s.radii.back()) : 0;
  if (!(sag < s.depths.back())) throw InputError(fmt::format("a sector's crown falls by {:g} m to its rim, and it is {:g} m deep", sag, s.depths.back()));
  return Builder(s).take();
}

}  // namespace tack
