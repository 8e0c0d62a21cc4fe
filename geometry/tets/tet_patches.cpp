#include "geometry/tets/tet_patches.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>

namespace tack {
namespace {

// A patch around a vertex has at least that many tets, and that fraction of all tets around the vertex.
constexpr int tet_count_min = 5;
constexpr double tet_fraction_min = 0.8;
// Numbers of tets of a patch between others; smaller ones join a neighbour.
constexpr int patch_size_min = 3, patch_size_max = 6;

std::vector<int> vertices_of(const std::vector<Tet>& tets, const std::vector<int>& patch) {
  std::vector<int> all;
  for (const int t : patch) all.insert(all.end(), tets[t].begin(), tets[t].end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

class Patches {
 public:
  explicit Patches(const std::vector<Tet>& tets) : tets_(tets), patch_(tets.size(), -1) {}

  std::vector<int> find() {
    cells();
    about_vertices();
    connect();
    between();
    renumber();
    return patch_;
  }

 private:
  // Finds cells: six consecutive tets around an edge that all of them share.
  void cells() {
    std::vector<int> six(6);
    for (int t = 0; t + 6 <= static_cast<int>(tets_.size());) {
      for (int i = 0; i < 6; ++i) six[i] = t + i;
      const std::vector<int> vertices = vertices_of(tets_, six);
      const auto in_all = [&](int v) {
        return std::all_of(six.begin(), six.end(), [&](int s) { return std::find(tets_[s].begin(), tets_[s].end(), v) != tets_[s].end(); });
      };
      const bool cell = vertices.size() == 8 && std::count_if(vertices.begin(), vertices.end(), in_all) == 2;
      if (cell) take(six);
      t += cell ? 6 : 1;
    }
  }

  void about_vertices() {
    std::unordered_map<int, std::vector<int>> around;
    for (int t = 0; t < static_cast<int>(tets_.size()); ++t)
      for (const int v : tets_[t])
        if (patch_[t] < 0) around[v].push_back(t);
    std::vector<std::pair<int, int>> order;  // by descending number of tets, then by index
    for (const auto& [v, all] : around) order.emplace_back(-static_cast<int>(all.size()), v);
    std::sort(order.begin(), order.end());
    for (const auto& [minus_count, v] : order) {
      std::vector<int> open;
      for (const int t : around[v])
        if (patch_[t] < 0) open.push_back(t);
      const auto count = static_cast<double>(open.size());
      if (count < tet_count_min || count < -tet_fraction_min * minus_count) continue;
      while (static_cast<int>(vertices_of(tets_, open).size()) > largest_patch) open.pop_back();
      take(open);
    }
  }

  void connect() {
    std::map<std::array<int, 3>, int> first;
    neighbours_.resize(tets_.size());
    for (int t = 0; t < static_cast<int>(tets_.size()); ++t)
      for (int i = 0; i < 4; ++i) {
        std::array<int, 3> face{tets_[t][(i + 1) % 4], tets_[t][(i + 2) % 4], tets_[t][(i + 3) % 4]};
        std::sort(face.begin(), face.end());
        const auto [at, is_new] = first.try_emplace(face, t);
        if (is_new) continue;
        neighbours_[t].push_back(at->second);
        neighbours_[at->second].push_back(t);
      }
  }

  // Groups the remaining tets by common faces.
  void between() {
    for (int t = 0; t < static_cast<int>(tets_.size()); ++t) {
      if (patch_[t] >= 0) continue;
      std::vector<int> group{t};
      patch_[t] = count_;
      for (size_t i = 0; i < group.size(); ++i)
        for (const int s : neighbours_[group[i]])
          if (patch_[s] < 0 && group.size() < patch_size_max) {
            patch_[s] = count_;
            group.push_back(s);
          }
      if (group.size() >= patch_size_min || !join_neighbour(group)) members_.push_back(std::move(group)), ++count_;
    }
  }

  // Adds a group to the patch with the most common faces that does not become too large; returns false if there is none.
  bool join_neighbour(const std::vector<int>& group) {
    std::map<int, int> faces;
    for (const int t : group)
      for (const int s : neighbours_[t])
        if (patch_[s] >= 0 && patch_[s] != count_) --faces[patch_[s]];
    std::vector<std::pair<int, int>> order;
    for (const auto& [patch, minus_shared] : faces) order.emplace_back(minus_shared, patch);
    std::sort(order.begin(), order.end());
    for (const auto& [minus_shared, patch] : order) {
      std::vector<int> both = members_[patch];
      both.insert(both.end(), group.begin(), group.end());
      if (static_cast<int>(vertices_of(tets_, both).size()) > largest_patch) continue;
      for (const int t : group) patch_[t] = patch;
      members_[patch] = std::move(both);
      return true;
    }
    return false;
  }

  void take(const std::vector<int>& group) {
    for (const int t : group) patch_[t] = count_;
    members_.push_back(group);
    ++count_;
  }

  void renumber() {
    std::vector<int> number(count_, -1);
    int next = 0;
    for (int& p : patch_) {
      if (number[p] < 0) number[p] = next++;
      p = number[p];
    }
  }

  const std::vector<Tet>& tets_;
  std::vector<int> patch_;
  std::vector<std::vector<int>> members_, neighbours_;  // tets of each patch; tets at the faces of each tet
  int count_ = 0;
};

}  // namespace

std::vector<int> tet_patches(const std::vector<Tet>& tets) { return Patches(tets).find(); }

}  // namespace tack
