#include "framework/contact/clipped/clipped_adhesion_term.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "framework/assembly/stencil_blocks.hpp"
#include "framework/contact/law_debonding.hpp"
#include "framework/core/concurrent_maximum.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Step of the differences of the exact Hessian, per length of the first edge of b. They are of
// fourth order, because crossings of nearly parallel edges have large third derivatives.
constexpr double difference_step = 3e-6;
// Relative difference up to which two surfaces are equal in area: round-off of their sums.
constexpr double equal_area_ratio = 1e-9;
// Pairs of a chunk: one pair takes about a microsecond.
constexpr int pairs_per_chunk = 64;

Vec3 area_vector(const std::array<Vec3, 3>& x) { return 0.5 * (x[1] - x[0]).cross(x[2] - x[0]); }

}  // namespace

ClippedAdhesionTerm::ClippedAdhesionTerm(const ContactSystem& system, ClippedLaws laws)
    : Term("clipped_adhesion"), system_(system), laws_(std::move(laws)), topology_(system.surface()) {
  const ContactSurface& surface = system_.surface();
  const CollisionMesh& mesh = surface.mesh;
  std::map<Edge, std::vector<int>> at_edge;
  surface_area_.assign(system_.pairs().objects(), 0);
  heights_.resize(mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const std::array<Vec3, 3> x = corners(surface.rest, mesh.triangles[t]);
    const double area = area_vector(x).norm();
    surface_area_[mesh.vertex_object[mesh.triangles[t][0]]] += area;
    for (int k = 0; k < 3; ++k) {
      const int from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
      at_edge[{std::min(from, to), std::max(from, to)}].push_back(t);
      heights_[t][k] = topology_.smooth_edge(t, k) ? 0 : 2 * area / (x[(k + 1) % 3] - x[k]).norm();
    }
  }
  for (const auto& [from, to] : mesh.edges) {
    first_at_edge_.push_back(static_cast<int>(triangles_at_edge_.size()));
    if (const auto found = at_edge.find({std::min(from, to), std::max(from, to)}); found != at_edge.end())
      triangles_at_edge_.insert(triangles_at_edge_.end(), found->second.begin(), found->second.end());
  }
  first_at_edge_.push_back(static_cast<int>(triangles_at_edge_.size()));
}

// Returns whether the planes of `object` are used towards the other.
bool ClippedAdhesionTerm::has_planes(int object, int other) const {
  const ClippedPlanes planes = laws_.planes(object, other);
  if (planes == ClippedPlanes::of_first || planes == ClippedPlanes::of_second) return planes == ClippedPlanes::of_first;
  if (planes == ClippedPlanes::of_coarser) return system_.pairs().finer(other, object);
  const double own = surface_area_[object], others = surface_area_[other];
  if (std::abs(own - others) > equal_area_ratio * (own + others)) return own > others;
  return system_.pairs().finer(other, object);
}

void ClippedAdhesionTerm::add_pair(int triangle, int other, std::vector<TrianglePair>& pairs) const {
  const CollisionMesh& mesh = system_.surface().mesh;
  const int a = mesh.vertex_object[mesh.triangles[triangle][0]], b = mesh.vertex_object[mesh.triangles[other][0]];
  if (a == b) return;
  const int law = laws_.between(a, b);
  if (law < 0) return;
  if (has_planes(b, a)) pairs.push_back({triangle, other, law});
  else pairs.push_back({other, triangle, law});
}

// Two triangles within range have a vertex and a triangle, or two edges, within range.
void ClippedAdhesionTerm::find_pairs() {
  const Candidates& candidates = system_.candidates();
  const std::vector<Edge>& edges = system_.surface().mesh.edges;
  const int points = static_cast<int>(candidates.point_triangle.size()), all = points + static_cast<int>(candidates.edge_edge.size());
  std::vector<std::vector<TrianglePair>> found(chunk_count(all));
  for_each_chunk(all, [&](int chunk, int first, int last) {
    for (int i = first; i < last; ++i) {
      if (i < points) {
        const auto& [point, triangle] = candidates.point_triangle[i];
        for (const int t : topology_.triangles_at(point)) add_pair(t, triangle, found[chunk]);
        continue;
      }
      const auto& [ea, eb] = candidates.edge_edge[i - points];
      const std::vector<int>& object = system_.surface().mesh.vertex_object;
      if (laws_.between(object[edges[ea][0]], object[edges[eb][0]]) < 0) continue;
      for (int k = first_at_edge_[ea]; k < first_at_edge_[ea + 1]; ++k)
        for (int l = first_at_edge_[eb]; l < first_at_edge_[eb + 1]; ++l)
          add_pair(triangles_at_edge_[k], triangles_at_edge_[l], found[chunk]);
    }
    std::sort(found[chunk].begin(), found[chunk].end());
    found[chunk].erase(std::unique(found[chunk].begin(), found[chunk].end()), found[chunk].end());
  });
  pairs_.clear();
  for (const auto& some : found) pairs_.insert(pairs_.end(), some.begin(), some.end());
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
}

// Takes the sides of two-sided triangles that face each other.
ClippedAdhesionTerm::ActivePair ClippedAdhesionTerm::orient(const VecX& x, const TrianglePair& pair) const {
  const std::vector<Triangle>& triangles = system_.surface().mesh.triangles;
  const Triangle &ta = triangles[pair.a], &tb = triangles[pair.b];
  const std::array<Vec3, 3> a = corners(x, ta), b = corners(x, tb);
  const Vec3 normal_b = area_vector(b);
  const bool flipped_b = topology_.two_sided(pair.b) && normal_b.dot(a[0] + a[1] + a[2] - b[0] - b[1] - b[2]) < 0;
  const double facing = area_vector(a).dot(normal_b) * (flipped_b ? -1 : 1);
  const bool flipped_a = topology_.two_sided(pair.a) && facing > 0;
  ActivePair active{pair, {ta[0], ta[1], ta[2], tb[0], tb[1], tb[2]}, flipped_a, flipped_b};
  if (flipped_a) std::swap(active.vertices[1], active.vertices[2]);
  if (flipped_b) std::swap(active.vertices[4], active.vertices[5]);
  return active;
}

ClippedPair ClippedAdhesionTerm::geometry(const VecX& x, const ActivePair& active) const {
  const double strip = laws_.laws()[active.pair.law].strip;
  // Swapping corners 1 and 2 turns edges 0, 1, 2 into 2, 1, 0.
  const auto edge = [](bool flipped, int k) { return flipped ? 2 - k : k; };
  ClippedPair pair;
  for (int k = 0; k < 3; ++k) {
    pair.a[k] = vertex(x, active.vertices[k]);
    pair.b[k] = vertex(x, active.vertices[3 + k]);
    pair.boundary_a[k] = heights_[active.pair.a][edge(active.flipped_a, k)] > 0;
    pair.owns_b[k] = active.vertices[3 + k] < active.vertices[3 + (k + 1) % 3];
    pair.strip_b[k] = std::min(strip, 0.5 * heights_[active.pair.b][edge(active.flipped_b, k)]);
  }
  return pair;
}

template <class Act>
void ClippedAdhesionTerm::for_each_active(const VecX& x, int first, int last, const Act& act) const {
  for (int i = first; i < last; ++i)
    act(i, geometry(x, active_[i]), laws_.laws()[active_[i].pair.law]);
}

void ClippedAdhesionTerm::move_to(const VecX& x) {
  if (version_ != system_.candidates_version()) {
    find_pairs();
    version_ = system_.candidates_version();
  }
  const int all = static_cast<int>(pairs_.size());
  std::vector<std::vector<ActivePair>> found(chunk_count(all, pairs_per_chunk));
  for_each_chunk(all, [&](int chunk, int first, int last) {
    ClipIntegrator integrator;
    for (int i = first; i < last; ++i) {
      const ActivePair active = orient(x, pairs_[i]);
      if (integrator.overlaps(geometry(x, active), laws_.laws()[pairs_[i].law].range)) found[chunk].push_back(active);
    }
  }, pairs_per_chunk);
  active_.clear();
  for (const auto& some : found) active_.insert(active_.end(), some.begin(), some.end());
}

void ClippedAdhesionTerm::clear_caches() {
  version_ = -1;
  pairs_.clear();
  active_.clear();
}

double ClippedAdhesionTerm::value(const VecX& x) const {
  return sum_chunks(pair_count(), [&](int first, int last) {
    ClipIntegrator integrator;
    double sum = 0;
    for_each_active(x, first, last, [&](int, const ClippedPair& pair, const ClippedLaw& law) {
      sum += integrator.value(pair, law.law, law.bands).energy;
    });
    return sum;
  }, pairs_per_chunk);
}

std::vector<StencilBatch> ClippedAdhesionTerm::batches() const {
  batch_vertices_.clear();
  for (const ActivePair& active : active_) batch_vertices_.insert(batch_vertices_.end(), active.vertices.begin(), active.vertices.end());
  return {{6, pair_count(), batch_vertices_.data()}};
}

void ClippedAdhesionTerm::derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const {
  constexpr int slots = 9 * hessian_blocks(6);
  for_each_chunk(pair_count(), [&](int, int first, int last) {
    ClipIntegrator integrator;
    for_each_active(x, first, last, [&](int i, const ClippedPair& pair, const ClippedLaw& law) {
      Vec18 g;
      Mat18 h;
      integrator.derivatives(pair, law.law, law.bands, g, hessian && projection != Projection::none ? &h : nullptr);
      Eigen::Map<Vec18>{gradient + 18 * static_cast<size_t>(i)} = g;
      if (!hessian) return;
      if (projection == Projection::none) {
        const double step = difference_step * (pair.b[1] - pair.b[0]).norm();
        for (int k = 0; k < 18; ++k) {
          ClippedPair moved = pair;
          double& coordinate = (k < 9 ? moved.a[k / 3] : moved.b[k / 3 - 3])[k % 3];
          const double at = coordinate;
          h.col(k).setZero();
          for (const auto& [steps, weight] : {std::pair{-2, 1.0}, {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
            coordinate = at + steps * step;
            integrator.derivatives(moved, law.law, law.bands, g, nullptr);
            h.col(k) += weight / (12 * step) * g;
          }
        }
        h = (0.5 * (h + h.transpose())).eval();
      }
      store_blocks<6>(h, hessian + slots * static_cast<size_t>(i));
    });
  }, pairs_per_chunk);
}

// The gap of a pair is that of the centre of a over the plane of b.
void ClippedAdhesionTerm::mark_debonding(const VecX& from, const VecX& to, std::vector<char>& vertices) const {
  const auto gap = [](const ClippedPair& pair) {
    return area_vector(pair.b).normalized().dot((pair.a[0] + pair.a[1] + pair.a[2]) / 3 - pair.b[0]);
  };
  for_each(pair_count(), [&](int i) {
    const ClippedLaw& law = laws_.laws()[active_[i].pair.law];
    const double before = gap(geometry(from, active_[i])), after = gap(geometry(to, active_[i]));
    if (!passes_peak(law.law, law.range, before, after)) return;
    for (const int v : active_[i].vertices) mark(vertices[v]);
  });
}

bool ClippedAdhesionTerm::visit_energies(const VecX& x, const EnergyVisitor& visit) const {
  ClipIntegrator integrator;
  for_each_active(x, 0, pair_count(), [&](int i, const ClippedPair& pair, const ClippedLaw& law) {
    visit(active_[i].vertices, integrator.value(pair, law.law, law.bands).energy);
  });
  return true;
}

void ClippedAdhesionTerm::publish(Records& records) const {
  ForceRecord force{"clipped_adhesion", ForceDirection::normal, {"adhesion"}};
  const auto gradients = [this](const VecX& x) {
    std::vector<Vec18> all(active_.size());
    for_each_chunk(pair_count(), [&](int, int first, int last) {
      ClipIntegrator integrator;
      for_each_active(x, first, last, [&](int i, const ClippedPair& pair, const ClippedLaw& law) {
        integrator.derivatives(pair, law.law, law.bands, all[i], nullptr);
      });
    }, pairs_per_chunk);
    return all;
  };
  force.add = [this, gradients](const VecX& x, std::string_view, VecX& forces) {
    const std::vector<Vec18> all = gradients(x);
    for (size_t i = 0; i < all.size(); ++i)
      for (int k = 0; k < 6; ++k) vertex(forces, active_[i].vertices[k]) -= all[i].segment<3>(3 * k);
  };
  force.between = [this, gradients](const VecX& x, std::string_view, ObjectPair objects) {
    const std::vector<Vec18> all = gradients(x);
    const std::vector<int>& object = system_.surface().mesh.vertex_object;
    Vec3 sum = Vec3::Zero();
    for (size_t i = 0; i < all.size(); ++i) {
      const int a = object[active_[i].vertices[0]], b = object[active_[i].vertices[3]];
      const int first = a == objects.a && b == objects.b ? 0 : a == objects.b && b == objects.a ? 3 : -1;
      for (int k = first; first >= 0 && k < first + 3; ++k) sum -= all[i].segment<3>(3 * k);
    }
    return sum;
  };
  // Along the normal of b, positive where the vertex is pressed.
  force.add_compressions = [this, gradients](const VecX& x, std::string_view, VecX& pressed) {
    const std::vector<Vec18> all = gradients(x);
    for (size_t i = 0; i < all.size(); ++i) {
      const Vec3 normal = area_vector(geometry(x, active_[i]).b).normalized();
      for (int k = 0; k < 6; ++k)
        pressed(3 * active_[i].vertices[k]) -= (k < 3 ? 1 : -1) * all[i].segment<3>(3 * k).dot(normal);
    }
  };
  records.add(std::move(force));
  records.add(EnergyRecord{"adhesion", EnergyKind::contact, [this](const VecX& x) { return value(x); }});
}

}  // namespace tack
