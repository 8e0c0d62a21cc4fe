#include "geometry/mesh/cleanup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "geometry/errors.hpp"
#include "geometry/mesh/sorted.hpp"

namespace tack {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    const auto bits = [](std::int64_t i) { return static_cast<std::uint64_t>(i); };
    return bits(c[0]) * 73856093u ^ bits(c[1]) * 19349663u ^ bits(c[2]) * 83492791u;
  }
};

// Hash grid of the vertices kept so far. Cells are as wide as the tolerance, so that the 27 cells
// around a point contain every kept vertex within the tolerance.
class KeptVertices {
 public:
  explicit KeptVertices(double tolerance) : tolerance_(tolerance) {}

  // Returns the index of the first kept vertex within the tolerance; keeps x if there is none.
  int find_or_keep(const Vec3& x) {
    const Cell cell = cell_of(x);
    int best = -1;
    const int reach = tolerance_ > 0 ? 1 : 0;
    for (int i = -reach; i <= reach; ++i) {
      for (int j = -reach; j <= reach; ++j) {
        for (int k = -reach; k <= reach; ++k) {
          best = first_in({cell[0] + i, cell[1] + j, cell[2] + k}, x, best);
        }
      }
    }
    if (best >= 0) return best;
    kept_.push_back(x);
    cells_[cell].push_back(static_cast<int>(kept_.size()) - 1);
    return static_cast<int>(kept_.size()) - 1;
  }

  std::vector<Vec3> take() { return std::move(kept_); }

 private:
  Cell cell_of(const Vec3& x) const {
    Cell cell;
    for (int i = 0; i < 3; ++i) {
      // Adding 0 turns -0 into +0, whose bits would differ; the clamp keeps the cast defined.
      cell[i] = tolerance_ > 0 ? static_cast<std::int64_t>(
                                     std::clamp(std::floor(x[i] / tolerance_), -1e18, 1e18))
                               : std::bit_cast<std::int64_t>(x[i] + 0.0);
    }
    return cell;
  }

  int first_in(const Cell& cell, const Vec3& x, int best) const {
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return best;
    for (int v : found->second) {
      if ((best < 0 || v < best) && (kept_[v] - x).norm() <= tolerance_) best = v;
    }
    return best;
  }

  double tolerance_;
  std::vector<Vec3> kept_;
  std::unordered_map<Cell, std::vector<int>, CellHash> cells_;
};

template <class Element>
void remap(std::vector<Element>& elements, const std::vector<int>& new_index) {
  for (Element& element : elements) {
    for (int& v : element) v = new_index[v];
  }
  std::erase_if(elements, [](const Element& element) {
    const Element s = sorted(element);
    return std::adjacent_find(s.begin(), s.end()) != s.end();
  });
}

// Renumbers all vertices. new_index[old] is -1 for a removed vertex, which no element uses.
void remap_vertices(Mesh& mesh, const std::vector<int>& new_index) {
  remap(mesh.tets, new_index);
  remap(mesh.triangles, new_index);
  remap(mesh.edges, new_index);
  const auto remap_list = [&](std::vector<int>& list) {
    for (int& v : list) v = new_index[v];
    std::erase(list, -1);
  };
  remap_list(mesh.points);
  for (auto& [name, group] : mesh.tags) {
    remap_list(group);
    sort_unique(group);
  }
}

// Appends all sub-elements with N vertices, each with ascending vertices.
template <std::size_t N, class Element>
void collect_faces(const std::vector<Element>& elements, std::vector<std::array<int, N>>& faces) {
  const int corners = static_cast<int>(Element{}.size());
  for (const Element& element : elements) {
    const Element s = sorted(element);
    for (unsigned subset = 0; subset < (1u << corners); ++subset) {
      if (std::popcount(subset) != static_cast<int>(N)) continue;
      std::array<int, N> face;
      int n = 0;
      for (int i = 0; i < corners; ++i) {
        if (subset >> i & 1u) face[n++] = s[i];
      }
      faces.push_back(face);
    }
  }
}

template <class Element>
void erase_known(std::vector<Element>& elements, std::vector<Element>& known) {
  std::sort(known.begin(), known.end());
  std::erase_if(elements, [&](const Element& element) {
    return std::binary_search(known.begin(), known.end(), sorted(element));
  });
}

std::vector<char> used_by_cells(const Mesh& mesh) {
  std::vector<char> used(mesh.vertices.size(), 0);
  const auto mark = [&](const auto& elements) {
    for (const auto& element : elements) {
      for (int v : element) used[v] = 1;
    }
  };
  mark(mesh.tets);
  mark(mesh.triangles);
  mark(mesh.edges);
  return used;
}

}  // namespace

void merge_duplicate_vertices(Mesh& mesh, double tolerance) {
  if (!(tolerance >= 0) || !std::isfinite(tolerance)) {
    throw InputError(fmt::format("vertices cannot be merged within {} m: give zero or a positive "
                                 "tolerance",
                                 tolerance));
  }
  KeptVertices kept(tolerance);
  std::vector<int> new_index(mesh.vertices.size());
  for (std::size_t v = 0; v < new_index.size(); ++v) {
    new_index[v] = kept.find_or_keep(mesh.vertices[v]);
  }
  mesh.vertices = kept.take();
  remap_vertices(mesh, new_index);
  sort_unique(mesh.points);
}

void drop_redundant_elements(Mesh& mesh) {
  std::vector<Triangle> faces;
  collect_faces<3>(mesh.tets, faces);
  erase_known(mesh.triangles, faces);
  std::vector<Edge> edges;
  collect_faces<2>(mesh.tets, edges);
  collect_faces<2>(mesh.triangles, edges);
  erase_known(mesh.edges, edges);
  const std::vector<char> used = used_by_cells(mesh);
  std::erase_if(mesh.points, [&](int v) { return used[v]; });
}

void drop_unused_vertices(Mesh& mesh) {
  std::vector<char> used = used_by_cells(mesh);
  for (int v : mesh.points) used[v] = 1;
  std::vector<int> new_index(mesh.vertices.size(), -1);
  int count = 0;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    mesh.vertices[count] = mesh.vertices[v];
    new_index[v] = count++;
  }
  mesh.vertices.resize(count);
  remap_vertices(mesh, new_index);
}

}  // namespace tack
