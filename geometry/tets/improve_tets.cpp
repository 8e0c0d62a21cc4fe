#include "geometry/tets/improve_tets.hpp"

#include <algorithm>

#include "geometry/tets/mean_ratio.hpp"
#include "geometry/tets/tet_changes.hpp"

namespace tack {
namespace {

constexpr int pass_count_max = 12;

// Returns the tets below the goal, worst first.
std::vector<int> poor(const TetEditor& mesh, double goal) {
  std::vector<int> tets;
  for (int t = 0; t < mesh.count(); ++t)
    if (mesh.alive(t) && mesh.quality(t) < goal) tets.push_back(t);
  std::stable_sort(tets.begin(), tets.end(), [&](int a, int b) { return mesh.quality(a) < mesh.quality(b); });
  return tets;
}

constexpr std::array<Edge, 6> edges = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

// Makes the first change that improves a tet; returns false if there is none. Changes that keep the number of vertices come first,
// then merging and adding vertices.
bool improve(TetEditor& mesh, int tet) {
  const Tet t = mesh.tet(tet);
  for (const auto& [i, j] : edges)
    if (remove_edge(mesh, t[i], t[j])) return true;
  for (int corner = 0; corner < 4; ++corner)
    if (remove_face(mesh, tet, corner)) return true;
  for (const int v : t)
    if (smooth(mesh, v)) return true;
  for (const auto& [i, j] : edges)
    if (collapse(mesh, t[i], t[j]) || collapse(mesh, t[j], t[i])) return true;
  for (const auto& [i, j] : edges)
    if (split_edge(mesh, t[i], t[j])) return true;
  return insert(mesh, tet);
}

}  // namespace

ImprovedTets improve_tets(const std::vector<Vec3>& vertices, const std::vector<Tet>& tets, double goal) {
  TetEditor mesh(vertices, tets);
  ImprovedTets result;
  result.before = mesh.worst_of(tets);
  std::vector<int> tried;  // per tet: number of changes when none improved it; -1: not tried
  for (int pass = 0; pass < pass_count_max; ++pass) {
    const int before = mesh.changes();
    for (const int t : poor(mesh, goal)) {
      if (!mesh.alive(t) || !(mesh.quality(t) < goal)) continue;
      tried.resize(static_cast<size_t>(mesh.count()), -1);
      if (mesh.last_change_near(t) <= tried[t]) continue;
      if (!improve(mesh, t)) tried[t] = mesh.changes();
    }
    if (mesh.changes() == before) break;
  }
  std::vector<int> number(mesh.positions().size(), -1);
  const auto take = [&](int v) {
    number[v] = static_cast<int>(result.vertices.size());
    result.vertices.push_back(mesh.position(v));
    const bool stayed = v < static_cast<int>(vertices.size()) && mesh.position(v) == vertices[v];
    result.from.push_back(stayed ? v : -1);
  };
  for (const bool surface : {true, false})
    for (size_t v = 0; v < mesh.positions().size(); ++v)
      if (mesh.on_surface(static_cast<int>(v)) == surface && !mesh.around(static_cast<int>(v)).empty()) take(static_cast<int>(v));
  std::vector<Tet> alive;
  for (int t = 0; t < mesh.count(); ++t) {
    if (!mesh.alive(t)) continue;
    const Tet& tet = mesh.tet(t);
    alive.push_back(tet);
    result.tets.push_back({number[tet[0]], number[tet[1]], number[tet[2]], number[tet[3]]});
    const bool kept = t < static_cast<int>(tets.size()) &&
                      std::all_of(tet.begin(), tet.end(), [&](int v) { return result.from[number[v]] >= 0; });
    result.kept.push_back(kept ? t : -1);
  }
  result.after = mesh.worst_of(alive);
  return result;
}

}  // namespace tack
