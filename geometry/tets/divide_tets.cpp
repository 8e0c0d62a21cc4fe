#include "geometry/tets/divide_tets.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

namespace tack {
namespace {

// Squared-length ratio below which a diagonal counts as shorter: the choice does not depend on round-off.
constexpr double length_ratio = 1 - 1e-6;

// Midpoints of edges, appended to the vertices of a mesh.
class Middles {
 public:
  explicit Middles(Mesh& mesh) : mesh_(mesh) {}

  int of(int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    const auto [at, is_new] = number_.try_emplace(static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high), 0);
    if (is_new) {
      at->second = static_cast<int>(mesh_.vertices.size());
      mesh_.vertices.push_back((mesh_.vertices[low] + mesh_.vertices[high]) / 2);
      ends_.push_back({low, high});
    }
    return at->second;
  }
  const std::vector<Edge>& ends() const { return ends_; }

 private:
  Mesh& mesh_;
  std::unordered_map<std::uint64_t, int> number_;
  std::vector<Edge> ends_;
};

// Returns the tet with its corners reordered, by an even permutation, such that the midpoints of its edges 01 and 23 are closest.
// Among equal lengths, the edge that joins the smallest vertex with the smallest partner counts.
Tet with_shortest_diagonal(const Tet& t, const std::vector<Vec3>& x) {
  std::array<Tet, 3> orders = {t, {t[0], t[2], t[3], t[1]}, {t[0], t[3], t[1], t[2]}};
  const int least = *std::min_element(t.begin(), t.end());
  const auto partner = [&](const Tet& o) { return o[static_cast<size_t>(std::find(o.begin(), o.end(), least) - o.begin()) ^ 1]; };
  std::sort(orders.begin(), orders.end(), [&](const Tet& a, const Tet& b) { return partner(a) < partner(b); });
  const auto square = [&](const Tet& o) { return (x[o[0]] + x[o[1]] - x[o[2]] - x[o[3]]).squaredNorm(); };
  Tet best = orders[0];
  for (int i = 1; i < 3; ++i)
    if (square(orders[i]) < length_ratio * square(best)) best = orders[i];
  return best;
}

}  // namespace

Mesh divide_tets(const Mesh& mesh) {
  Mesh fine;
  fine.vertices = mesh.vertices;
  fine.points = mesh.points;
  fine.tags = mesh.tags;
  Middles middles(fine);
  fine.tets.reserve(composite_parts * mesh.tets.size());
  for (const Tet& tet : mesh.tets) {
    const Tet t = with_shortest_diagonal(tet, mesh.vertices);
    CompositeTet nodes;
    std::copy(t.begin(), t.end(), nodes.begin());
    for (size_t e = 0; e < composite_edges.size(); ++e) nodes[4 + e] = middles.of(t[composite_edges[e][0]], t[composite_edges[e][1]]);
    for (const auto& part : composite_tets) fine.tets.push_back({nodes[part[0]], nodes[part[1]], nodes[part[2]], nodes[part[3]]});
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const int ab = middles.of(a, b), bc = middles.of(b, c), ca = middles.of(c, a);
    fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  for (const auto& [a, b] : mesh.edges) {
    const int middle = middles.of(a, b);
    fine.edges.insert(fine.edges.end(), {{a, middle}, {middle, b}});
  }
  for (auto& [name, vertices] : fine.tags) {
    std::vector<char> in(mesh.vertices.size(), 0);
    for (const int v : vertices) in[v] = 1;
    for (size_t m = 0; m < middles.ends().size(); ++m)
      if (const auto& [a, b] = middles.ends()[m]; in[a] && in[b]) vertices.push_back(static_cast<int>(mesh.vertices.size() + m));
  }
  return fine;
}

std::vector<CompositeTet> composite_tets_of(const std::vector<Tet>& parts) {
  std::vector<CompositeTet> all(parts.size() / composite_parts);
  for (size_t t = 0; t < all.size(); ++t)
    for (int p = 0; p < composite_parts; ++p)
      for (int i = 0; i < 4; ++i) all[t][composite_tets[p][i]] = parts[composite_parts * t + p][i];
  return all;
}

}  // namespace tack
