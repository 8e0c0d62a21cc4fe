#include "geometry/tets/tet_editor.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "geometry/mesh/sorted.hpp"
#include "geometry/tets/mean_ratio.hpp"

namespace tack {
namespace {

// faces[i]: the face opposite corner i, outward in a positive tet.
constexpr std::array<Triangle, 4> faces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

bool has(const Tet& tet, int vertex) { return std::find(tet.begin(), tet.end(), vertex) != tet.end(); }

}  // namespace

Tet reordered(const Tet& tet, int a, int b) {
  constexpr std::array<Tet, 12> even = {{{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 0, 3, 2}, {1, 2, 0, 3}, {1, 3, 2, 0},
                                         {2, 0, 1, 3}, {2, 1, 3, 0}, {2, 3, 0, 1}, {3, 0, 2, 1}, {3, 1, 0, 2}, {3, 2, 1, 0}}};
  for (const Tet& order : even)
    if (tet[order[0]] == a && tet[order[1]] == b) return {a, b, tet[order[2]], tet[order[3]]};
  return tet;
}

TetEditor::TetEditor(std::vector<Vec3> positions, std::vector<Tet> tets)
    : positions_(std::move(positions)), on_surface_(positions_.size(), 0), around_(positions_.size()), changed_(positions_.size(), 0) {
  replace({}, tets);
  std::vector<std::pair<Triangle, Triangle>> all;  // sorted, and as it is
  for (const Tet& t : tets_)
    for (const auto& [i, j, k] : faces) all.push_back({sorted(Triangle{t[i], t[j], t[k]}), {t[i], t[j], t[k]}});
  std::sort(all.begin(), all.end());
  for (size_t i = 0; i < all.size(); ++i) {
    const bool twice = (i + 1 < all.size() && all[i + 1].first == all[i].first) || (i > 0 && all[i - 1].first == all[i].first);
    if (!twice)
      for (const int v : all[i].second) on_surface_[v] = 1;
  }
}

double TetEditor::quality_of(const Tet& t) const { return mean_ratio({positions_[t[0]], positions_[t[1]], positions_[t[2]], positions_[t[3]]}); }

double TetEditor::worst_of(const std::vector<int>& tets) const {
  double worst = std::numeric_limits<double>::infinity();
  for (const int t : tets) worst = std::min(worst, quality_[t]);
  return worst;
}

double TetEditor::worst_of(const std::vector<Tet>& tets) const {
  double worst = std::numeric_limits<double>::infinity();
  for (const Tet& t : tets) worst = std::min(worst, quality_of(t));
  return worst;
}

std::vector<int> TetEditor::around_edge(int a, int b) const {
  std::vector<int> both;
  for (const int t : around_[a])
    if (has(tets_[t], b)) both.push_back(t);
  return both;
}

std::vector<int> TetEditor::ring(int a, int b, const std::vector<int>& around) const {
  std::map<int, int> next;
  for (const int t : around) {
    const Tet tet = reordered(tets_[t], a, b);
    next[tet[2]] = tet[3];
  }
  std::vector<int> ring;
  if (next.size() != around.size() || next.empty()) return ring;
  int v = next.begin()->first;
  do {
    ring.push_back(v);
    const auto found = next.find(v);
    if (found == next.end()) return {};
    v = found->second;
  } while (v != ring[0] && ring.size() <= next.size());
  return ring.size() == next.size() && v == ring[0] ? ring : std::vector<int>();
}

int TetEditor::across(int tet, int corner) const {
  const Tet& t = tets_[tet];
  const auto& [i, j, k] = faces[corner];
  for (const int other : around_[t[i]])
    if (other != tet && has(tets_[other], t[j]) && has(tets_[other], t[k])) return other;
  return -1;
}

int TetEditor::last_change_near(int tet) const {
  int last = 0;
  for (const int v : tets_[tet]) last = std::max(last, changed_[v]);
  return last;
}

void TetEditor::record_change(const Tet& tet) {
  for (const int v : tet) changed_[v] = changes_;
}

void TetEditor::replace(const std::vector<int>& tets, const std::vector<Tet>& by) {
  ++changes_;
  for (const int t : tets) {
    alive_[t] = 0;
    record_change(tets_[t]);
    for (const int v : tets_[t]) std::erase(around_[v], t);
  }
  for (const Tet& t : by) {
    const int number = count();
    tets_.push_back(t);
    alive_.push_back(1);
    quality_.push_back(quality_of(t));
    for (const int v : t) around_[v].push_back(number);
    record_change(t);
  }
}

int TetEditor::add_vertex(const Vec3& position) {
  positions_.push_back(position);
  on_surface_.push_back(0);
  around_.emplace_back();
  changed_.push_back(0);
  return static_cast<int>(positions_.size()) - 1;
}

void TetEditor::move(int vertex, const Vec3& position) {
  ++changes_;
  positions_[vertex] = position;
  for (const int t : around_[vertex]) {
    quality_[t] = quality_of(tets_[t]);
    record_change(tets_[t]);
  }
}

}  // namespace tack
