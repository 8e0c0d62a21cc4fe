#include "geometry/mesh/flip_slivers.hpp"

#include <unordered_map>

#include "geometry/mesh/quality.hpp"

namespace tack {
namespace {

class Flipper {
 public:
  Flipper(Mesh& mesh, double height) : mesh_(mesh), height_(height) {}

  int run() {
    constexpr int rounds = 4;
    int turned = 0;
    for (int round = 0; round < rounds; ++round) {
      std::vector<int> low;
      for (size_t t = 0; t < mesh_.triangles.size(); ++t)
        if (height(mesh_.triangles[t]) < height_) low.push_back(static_cast<int>(t));
      if (low.empty()) break;
      if (sides_.empty()) collect();
      int now = 0;
      for (const int t : low) now += flip(t);
      turned += now;
      if (now == 0) break;
    }
    return turned;
  }

 private:
  // Returns the key of the directed edge from a to b.
  static std::uint64_t key(int a, int b) { return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b); }

  double length(int a, int b) const { return (mesh_.vertices[a] - mesh_.vertices[b]).norm(); }
  // Returns the smallest of the three heights.
  double height(const Triangle& t) const {
    const double longest = std::max({length(t[0], t[1]), length(t[1], t[2]), length(t[2], t[0])});
    return longest > 0 ? 2 * triangle_area(mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]) / longest : 0;
  }

  void collect() {
    sides_.reserve(3 * mesh_.triangles.size());
    for (size_t t = 0; t < mesh_.triangles.size(); ++t) enter(static_cast<int>(t));
  }
  void enter(int t) {
    for (int k = 0; k < 3; ++k) sides_[key(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3])] = t;
  }

  int flip(int t) {
    const Triangle own = mesh_.triangles[t];
    if (height(own) >= height_) return 0;
    int k = 0;
    for (int i = 1; i < 3; ++i)
      if (length(own[i], own[(i + 1) % 3]) > length(own[k], own[(k + 1) % 3])) k = i;
    const int a = own[k], b = own[(k + 1) % 3], c = own[(k + 2) % 3];
    const auto beside = sides_.find(key(b, a));
    if (beside == sides_.end() || beside->second == t) return 0;
    const int s = beside->second;
    int d = -1;
    for (const int v : mesh_.triangles[s])
      if (v != a && v != b) d = v;
    if (d < 0 || d == c || sides_.contains(key(c, d)) || sides_.contains(key(d, c))) return 0;
    const Triangle first{a, d, c}, second{d, b, c};
    if (std::min(height(first), height(second)) <= std::min(height(own), height(mesh_.triangles[s]))) return 0;
    sides_.erase(key(a, b));
    sides_.erase(key(b, a));
    mesh_.triangles[t] = first;
    mesh_.triangles[s] = second;
    enter(t);
    enter(s);
    return 1;
  }

  Mesh& mesh_;
  double height_;
  std::unordered_map<std::uint64_t, int> sides_;
};

}  // namespace

int flip_slivers(Mesh& mesh, double height) { return Flipper(mesh, height).run(); }

}  // namespace tack
