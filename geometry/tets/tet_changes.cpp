#include "geometry/tets/tet_changes.hpp"

#include <algorithm>
#include <limits>

#include "geometry/tets/mean_ratio.hpp"
#include "geometry/tets/tet_star.hpp"

namespace tack {
namespace {

constexpr int ring_size_max = 12;
constexpr int cavity_size_max = 24;
constexpr double improvement_min = 1e-3;  // relative

// Returns the face opposite a corner, counter-clockwise from there.
Triangle inward(const Tet& t, int corner) {
  constexpr std::array<Triangle, 4> faces = {{{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};
  const auto& [i, j, k] = faces[corner];
  return {t[i], t[j], t[k]};
}

bool better(double quality, double than) { return quality > than * (1 + improvement_min) && quality > 0; }

// Triangulation of a ring for which the worst of the tets with both ends of the edge is best.
class RingFilling {
 public:
  RingFilling(const TetEditor& mesh, int a, int b, const std::vector<int>& ring) : a_(a), b_(b), ring_(ring), n_(static_cast<int>(ring.size())) {
    best_.assign(static_cast<size_t>(n_) * n_, std::numeric_limits<double>::infinity());
    split_.assign(static_cast<size_t>(n_) * n_, -1);
    for (int span = 2; span < n_; ++span)
      for (int i = 0; i + span < n_; ++i) {
        const int k = i + span;
        double& best = best_[i * n_ + k] = -1;
        for (int j = i + 1; j < k; ++j) {
          const auto [over, under] = tets(i, j, k);
          const double q = std::min({mesh.quality_of(over), mesh.quality_of(under), best_[i * n_ + j], best_[j * n_ + k]});
          if (q > best) best = q, split_[i * n_ + k] = j;
        }
      }
  }
  double worst() const { return best_[n_ - 1]; }
  std::vector<Tet> all() const {
    std::vector<Tet> made;
    add(0, n_ - 1, made);
    return made;
  }

 private:
  std::pair<Tet, Tet> tets(int i, int j, int k) const { return {{ring_[i], ring_[j], ring_[k], b_}, {ring_[i], ring_[k], ring_[j], a_}}; }
  void add(int i, int k, std::vector<Tet>& made) const {
    const int j = split_[i * n_ + k];
    if (k - i < 2 || j < 0) return;
    const auto [over, under] = tets(i, j, k);
    made.push_back(over);
    made.push_back(under);
    add(i, j, made);
    add(j, k, made);
  }

  int a_, b_;
  const std::vector<int>& ring_;
  int n_;
  std::vector<double> best_;
  std::vector<int> split_;
};

// Returns the faces around a vertex, counter-clockwise from it.
std::vector<Triangle> link(const TetEditor& mesh, int vertex) {
  std::vector<Triangle> all;
  for (const int t : mesh.around(vertex)) {
    const Tet& tet = mesh.tet(t);
    const int corner = static_cast<int>(std::find(tet.begin(), tet.end(), vertex) - tet.begin());
    all.push_back(inward(tet, corner));
  }
  return all;
}

// Replaces the tets of a cavity by those of its faces with a new vertex near a position.
bool fill_with_star(TetEditor& mesh, const std::vector<int>& cavity, const std::vector<Triangle>& faces, Vec3 position) {
  const TetStar star(mesh, faces);
  star.improve(position);
  if (!better(star.worst_at(position), mesh.worst_of(cavity))) return false;
  mesh.replace(cavity, star.tets(mesh.add_vertex(position)));
  return true;
}

}  // namespace

bool remove_edge(TetEditor& mesh, int a, int b) {
  const std::vector<int> around = mesh.around_edge(a, b), ring = mesh.ring(a, b, around);
  if (ring.size() < 3 || ring.size() > ring_size_max) return false;
  const RingFilling filling(mesh, a, b, ring);
  if (!better(filling.worst(), mesh.worst_of(around))) return false;
  mesh.replace(around, filling.all());
  return true;
}

bool remove_face(TetEditor& mesh, int tet, int corner) {
  const int other = mesh.across(tet, corner);
  if (other < 0) return false;
  const int inner = mesh.tet(tet)[corner];
  const auto [p, q, r] = inward(mesh.tet(tet), corner);
  int outer = -1;
  for (const int v : mesh.tet(other))
    if (v != p && v != q && v != r) outer = v;
  const std::vector<Tet> three = {{outer, inner, p, q}, {outer, inner, q, r}, {outer, inner, r, p}};
  if (!better(mesh.worst_of(three), std::min(mesh.quality(tet), mesh.quality(other)))) return false;
  mesh.replace({tet, other}, three);
  return true;
}

bool collapse(TetEditor& mesh, int vertex, int onto) {
  if (mesh.on_surface(vertex)) return false;
  const std::vector<int> around = mesh.around(vertex);
  std::vector<Tet> left;
  for (const int t : around) {
    Tet tet = mesh.tet(t);
    if (std::find(tet.begin(), tet.end(), onto) != tet.end()) continue;
    std::replace(tet.begin(), tet.end(), vertex, onto);
    left.push_back(tet);
  }
  if (!better(mesh.worst_of(left), mesh.worst_of(around))) return false;
  mesh.replace(around, left);
  return true;
}

bool smooth(TetEditor& mesh, int vertex) {
  if (mesh.on_surface(vertex)) return false;
  const TetStar star(mesh, link(mesh, vertex));
  Vec3 position = mesh.position(vertex);
  star.improve(position);
  if (position == mesh.position(vertex)) return false;
  mesh.move(vertex, position);
  return true;
}

bool split_edge(TetEditor& mesh, int a, int b) {
  const std::vector<int> around = mesh.around_edge(a, b), ring = mesh.ring(a, b, around);
  std::vector<Triangle> faces;
  for (size_t i = 0; i < ring.size(); ++i) {
    const int c = ring[i], d = ring[(i + 1) % ring.size()];
    faces.push_back({a, c, d});
    faces.push_back({c, b, d});
  }
  return !ring.empty() && fill_with_star(mesh, around, faces, (mesh.position(a) + mesh.position(b)) / 2);
}

bool insert(TetEditor& mesh, int tet) {
  Vec3 centre = Vec3::Zero();
  for (const int v : mesh.tet(tet)) centre += mesh.position(v) / 4;
  std::vector<int> cavity = {tet};
  // Adds the tet behind the worst face to the cavity, until that face is on the surface.
  while (cavity.size() < cavity_size_max) {
    std::vector<Triangle> faces;
    double worst = std::numeric_limits<double>::infinity();
    int behind = -1;
    for (const int t : cavity)
      for (int corner = 0; corner < 4; ++corner) {
        const int other = mesh.across(t, corner);
        if (other >= 0 && std::find(cavity.begin(), cavity.end(), other) != cavity.end()) continue;
        const Triangle face = inward(mesh.tet(t), corner);
        faces.push_back(face);
        const double quality = mean_ratio({mesh.position(face[0]), mesh.position(face[1]), mesh.position(face[2]), centre});
        if (quality < worst) worst = quality, behind = other;
      }
    if (fill_with_star(mesh, cavity, faces, centre)) return true;
    if (behind < 0) return false;
    cavity.push_back(behind);
  }
  return false;
}

}  // namespace tack
