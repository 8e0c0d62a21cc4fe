#include "geometry/mesh/refine_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "geometry/errors.hpp"
#include "geometry/mesh/sorted.hpp"

namespace tack {
namespace {

using Weights = std::vector<std::pair<int, double>>;

class Refinement {
 public:
  Refinement(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double edge_length, int most)
      : x_(std::move(vertices)), old_(static_cast<int>(x_.size())), edge_length_(edge_length), most_(most) {
    surface_.triangles = std::move(triangles);
  }

  RefinedSurface take() {
    while (halve_long_edges()) divide_triangles();
    return std::move(surface_);
  }

 private:
  bool is_long(const Edge& e) const {
    constexpr double round_off = 1e-9;
    return (x_[e[0]] - x_[e[1]]).norm() > (1 + round_off) * edge_length_;
  }

  bool halve_long_edges() {
    edges_.clear();
    for (const auto& [a, b, c] : surface_.triangles)
      for (const Edge& e : {sorted(Edge{a, b}), sorted(Edge{b, c}), sorted(Edge{c, a})})
        if (is_long(e)) edges_.push_back(e);
    sort_unique(edges_);
    if (edges_.size() + surface_.added.size() > static_cast<size_t>(most_))
      throw InputError(fmt::format("edges no longer than {:g} m would take more than {} new vertices of the surface; ask for "
                                   "longer ones", edge_length_, most_));
    first_middle_ = static_cast<int>(x_.size());
    for (const Edge& e : edges_) add_middle(e);
    return !edges_.empty();
  }

  void add_middle(const Edge& e) {
    std::map<int, double> weights;
    for (const int v : e) {
      const Weights own = v < old_ ? Weights{{v, 1.0}} : surface_.added[v - old_];
      for (const auto& [on, weight] : own) weights[on] += weight / 2;
    }
    Vec3 sum = Vec3::Zero();
    for (const auto& [on, weight] : weights) sum += weight * x_[on];
    surface_.added.emplace_back(weights.begin(), weights.end());
    x_.push_back(sum);
  }

  // Returns the new vertex of an edge; -1: the edge is not divided.
  int middle(int a, int b) const {
    const Edge e = sorted(Edge{a, b});
    const auto at = std::lower_bound(edges_.begin(), edges_.end(), e);
    return at != edges_.end() && *at == e ? first_middle_ + static_cast<int>(at - edges_.begin()) : -1;
  }

  void divide_triangles() {
    std::vector<Triangle> parts;
    for (const Triangle& t : surface_.triangles) divide(t, parts);
    surface_.triangles = std::move(parts);
  }

  void divide(Triangle t, std::vector<Triangle>& parts) const {
    std::array<int, 3> m = {middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
    const auto halved = std::count_if(m.begin(), m.end(), [](int v) { return v >= 0; });
    if (halved == 0) return parts.push_back(t);
    if (halved == 3) {
      parts.insert(parts.end(), {{t[0], m[0], m[2]}, {m[0], t[1], m[1]}, {m[2], m[1], t[2]}, {m[0], m[1], m[2]}});
      return;
    }
    // Rotates the corners so that the one bisected (or the one undivided) edge is from corner 0 to corner 1.
    while ((m[0] >= 0) != (halved == 1)) {
      std::rotate(t.begin(), t.begin() + 1, t.end());
      std::rotate(m.begin(), m.begin() + 1, m.end());
    }
    if (halved == 1) {
      parts.insert(parts.end(), {{t[0], m[0], t[2]}, {m[0], t[1], t[2]}});
      return;
    }
    parts.push_back({m[2], m[1], t[2]});  // the remaining quadrilateral is cut along its shorter diagonal
    if ((x_[t[0]] - x_[m[1]]).squaredNorm() <= (x_[t[1]] - x_[m[2]]).squaredNorm()) {
      parts.insert(parts.end(), {{t[0], t[1], m[1]}, {t[0], m[1], m[2]}});
    } else {
      parts.insert(parts.end(), {{t[0], t[1], m[2]}, {t[1], m[1], m[2]}});
    }
  }

  std::vector<Vec3> x_;
  int old_, first_middle_ = 0;
  double edge_length_;  // m
  int most_;
  std::vector<Edge> edges_;  // long edges, ascending
  RefinedSurface surface_;
};

}  // namespace

RefinedSurface refine_surface(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double edge_length, int most) {
  return Refinement(std::move(vertices), std::move(triangles), edge_length, most).take();
}

}  // namespace tack
