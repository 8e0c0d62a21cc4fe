// History of the sites that have bonded, for rules that let a site bond once (BondRule::once). The key of an entry is
// (first vertex of the site, other object); its value is the triangle, counted from the first one of its object, or -1.
#include <algorithm>
#include <stdexcept>

#include "framework/bond/bond_term.hpp"

namespace tack {
namespace {

constexpr const char* history_name = "contact/bonds once";

// Returns the first triangle of each object; triangles are ordered by object.
std::vector<int> first_triangles(const CollisionMesh& mesh) {
  std::vector<int> first;
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int object = mesh.vertex_object[mesh.triangles[t][0]]; static_cast<int>(first.size()) <= object;) first.push_back(static_cast<int>(t));
  return first;
}

}  // namespace

void BondTerm::read_bonded_once(const History& history) {
  bonded_once_.clear();
  const auto found = history.find(history_name);
  if (found == history.end()) return;
  const HistoryArray& array = found->second;
  if (array.width != 1 || static_cast<int>(array.keys.size()) != array.entries()) throw std::logic_error("the sites that have bonded have another width");
  const CollisionMesh& mesh = system_.surface().mesh;
  const std::vector<int> firsts = first_triangles(mesh);
  for (int e = 0; e < array.entries(); ++e) {
    const auto& [vertex, object] = array.keys[e];
    const int triangle = static_cast<int>(array.values[e]);
    bonded_once_.insert(key_of(triangle < 0 ? -1 : firsts[mesh.vertex_object[vertex]] + triangle, vertex, object));
  }
}

void BondTerm::write_bonded_once(History& history) const {
  std::set<SiteKey> sites = bonded_once_;
  for (const Bond& bond : list_.bonds())
    if (table_.rules()[bond.rule].once) sites.insert(key_of(bond.triangle, bond.vertices[0], bond.b));
  const CollisionMesh& mesh = system_.surface().mesh;
  const std::vector<int> firsts = first_triangles(mesh);
  std::vector<std::pair<std::array<int, 2>, int>> entries;
  for (const auto& [triangle, vertex, object] : sites) {
    const int first = triangle < 0 ? vertex : mesh.triangles[triangle][0];
    entries.push_back({{first, object}, triangle < 0 ? -1 : triangle - firsts[mesh.vertex_object[first]]});
  }
  std::sort(entries.begin(), entries.end());
  HistoryArray array{1, {}, {}};
  for (const auto& [key, triangle] : entries) {
    array.keys.push_back(key);
    array.values.push_back(triangle);
  }
  history[history_name] = std::move(array);
}

}  // namespace tack
