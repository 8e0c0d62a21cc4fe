#include "framework/contact/area_integral/vertex_quadrature.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "framework/contact/area_integral/weighted_features.hpp"
#include "framework/contact/stencils/rest_neighbours.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Weight of a rod or particle below which the safety barrier acts as well.
constexpr double small_weight = 0.1;

// Makes the quadrature points of one chunk of groups.
class QuadratureMaker {
 public:
  // add() expects groups in ascending order.
  QuadratureMaker(const VertexQuadratureRequest& r, const EarlierVertexQuadrature* earlier)
      : r_(r), mesh_(r.surface.mesh), earlier_(earlier), finder_(mesh_, r.lagged), codimensional_(mesh_, r.lagged) {}

  void add(int g) {
    const PointGroup& group = r_.candidates.groups.all[g];
    const int begin = static_cast<int>(out_.points.size());
    out_.group_begin.push_back(begin);
    if (!copy_earlier(group)) make(g);
    number_contact_points(begin);
  }
  VertexQuadrature take() { return std::move(out_); }

 private:
  void make(int g) {
    const PointGroup& group = r_.candidates.groups.all[g];
    const int own = mesh_.vertex_object[group.point];
    region_pair_ = nearest_region_pair(group, own);
    const PairRole& role = r_.pairs.point(own, group.object, region_pair_);
    if (role.law < 0) return;
    rule_ = r_.rules.of(own, group.object);
    if (!topology().triangles_at(group.point).empty()) {
      if (r_.sides.integrates(own, group.object)) add_pressure(g, role);
      else add_safety_barrier(group, safety_barrier_of(role), r_.lagged.tributary_area(group.point));
    }
    if (topology().is_codimensional(group.point) && group.triangle_end > group.triangle_begin) add_codimensional(group, role);
    if (has_rods_or_particles(group)) add_rods_and_particles(group, role);
  }

  // Copies the points of a group of triangles without changed primitives, if it has earlier points.
  // Rods and particles are made again, as their weights depend on other primitives.
  bool copy_earlier(const PointGroup& group) {
    if (!earlier_ || has_rods_or_particles(group) || topology().is_codimensional(group.point)) return false;
    const ChangedPrimitives& changed = earlier_->changed;
    if (changed.vertices[group.point] || changed.objects[group.object]) return false;
    if (group.before < 0) return false;
    const VertexQuadrature& earlier = earlier_->quadrature;
    for (int k = earlier.group_begin[group.before]; k < earlier.group_begin[group.before + 1]; ++k) {
      const VertexQuadraturePoint& point = earlier.points[k];
      begin_point(group, {point.law, point.range, point.area});
      for (int i = point.triangle_begin; i < point.triangle_end; ++i) out_.triangles.push_back(earlier.triangles[i] + group.triangle_shift);
      end_point();
    }
    return true;
  }

  // Numbers the contact points of a group by their laws. begin: its first quadrature point.
  void number_contact_points(int begin) {
    laws_.clear();
    const auto first = out_.points.begin() + begin;
    std::for_each(first, out_.points.end(), [&](const VertexQuadraturePoint& p) { laws_.push_back(p.law); });
    std::sort(laws_.begin(), laws_.end());
    laws_.erase(std::unique(laws_.begin(), laws_.end()), laws_.end());
    std::for_each(first, out_.points.end(), [&](VertexQuadraturePoint& p) {
      p.contact_point = out_.contact_point_count + static_cast<int>(std::lower_bound(laws_.begin(), laws_.end(), p.law) - laws_.begin());
    });
    out_.contact_point_count += static_cast<int>(laws_.size());
  }

  struct ActingLaw {
    int law;
    double range, area;
  };
  struct NearTriangle {
    int candidate, patch;  // index of the patch; -1: none
  };
  struct SafetyBarrier {
    int law;  // -1: none
    double range;
  };

  // Returns the region pair of the nearest primitive of the group.
  int nearest_region_pair(const PointGroup& group, int own) const {
    if (!r_.pairs.has_regions(own, group.object)) return -1;
    const VecX& x = r_.lagged.x();
    const std::array point{group.point};
    double nearest = std::numeric_limits<double>::infinity();
    int region_pair = -1;
    const auto consider = [&](const auto& element) {
      const double squared = squared_distance(corners(x, point), corners(x, element));
      if (squared < nearest) nearest = squared, region_pair = r_.pairs.region_pair(own, group.object, point, element);
    };
    for (int i = group.triangle_begin; i < group.triangle_end; ++i) consider(mesh_.triangles[triangle(i)]);
    for (int i = group.edge_begin; i < group.edge_end; ++i) consider(mesh_.edges[rod(i)]);
    for (int i = group.other_begin; i < group.other_end; ++i) consider(std::array{particle(i)});
    return region_pair;
  }

  const SurfaceTopology& topology() const { return r_.lagged.topology(); }
  double tributary_area(int point) const {
    return r_.lagged.tributary_area(point) + (topology().is_codimensional(point) ? r_.lagged.codimensional_area(point) : 0);
  }
  // Returns the safety barrier of a side that carries pressure, or the law of a side that does not.
  SafetyBarrier safety_barrier_of(const PairRole& role) const {
    if (rule_.carries_pressure) return {role.safety_barrier, role.safety_barrier_range};
    return {role.law, role.range};
  }
  int triangle(int i) const { return r_.candidates.point_triangle[i][1]; }
  int rod(int i) const { return r_.candidates.point_edge[i][1]; }
  int particle(int i) const { return r_.candidates.groups.particles[i][1]; }
  // Returns whether the pair may come within a range [m] while the candidates are valid.
  bool may_come_within(int i, double range) const { return r_.candidates.distance_bounds.point_triangle[i] < range; }

  // Begins a point. Within one object its law is the one that is cut down to the gap at rest.
  void begin_point(const PointGroup& group, ActingLaw acting) {
    if (const RestGaps* gaps = r_.surface.rest_gaps.get(); gaps && within_object(group))
      if (const int law = gaps->law_of_point(acting.law, group.point); law != acting.law) acting = {law, gaps->range(law), acting.area};
    const auto end = [](const std::vector<int>& list) { return static_cast<int>(list.size()); };
    const int t = end(out_.triangles), e = end(out_.edges), o = end(out_.others);
    out_.points.push_back({group.point, acting.law, acting.area, acting.range, t, t, -1, e, e, o, o});
  }
  // Ends a point. Points without primitives or without area are discarded.
  void end_point() {
    VertexQuadraturePoint& point = out_.points.back();
    point.triangle_end = static_cast<int>(out_.triangles.size());
    point.edge_end = static_cast<int>(out_.edges.size());
    point.other_end = static_cast<int>(out_.others.size());
    const bool empty = point.triangle_end == point.triangle_begin && point.edge_end == point.edge_begin &&
                       point.other_end == point.other_begin;
    if (empty || point.area == 0) discard(point);
  }
  void discard(const VertexQuadraturePoint& point) {
    out_.triangles.resize(point.triangle_begin);
    if (point.weight_begin >= 0) out_.weights.resize(point.weight_begin);
    out_.edges.resize(point.edge_begin);
    out_.others.resize(point.other_begin);
    out_.points.pop_back();
  }
  static bool has_rods_or_particles(const PointGroup& g) {
    return g.edge_end > g.edge_begin || g.other_end > g.other_begin;
  }

  void add_patch(const PointGroup& group, const ActingLaw& acting, int patch) {
    begin_point(group, acting);
    for (const NearTriangle& t : near_)
      if (t.patch == patch && may_come_within(t.candidate, acting.range)) out_.triangles.push_back(t.candidate);
    end_point();
  }

  void add_safety_barrier(const PointGroup& group, const SafetyBarrier& barrier, double area) {
    if (barrier.law < 0) return;
    begin_point(group, {barrier.law, barrier.range, area});
    for (int i = group.triangle_begin; i < group.triangle_end; ++i)
      if (may_come_within(i, barrier.range) && !neighbours(group, mesh_.triangles[triangle(i)], barrier.range))
        out_.triangles.push_back(i);
    end_point();
  }

  bool within_object(const PointGroup& group) const { return mesh_.vertex_object[group.point] == group.object; }
  template <size_t K>
  bool neighbours(const PointGroup& group, const std::array<int, K>& vertices, double range) const {
    return within_object(group) && rest_neighbours(r_.surface, std::array{group.point}, vertices, range);
  }

  // Lists the rods and particles of the group that are within range.
  void list_rods(const PointGroup& group, double range) {
    for (int i = group.edge_begin; i < group.edge_end; ++i)
      if (r_.candidates.distance_bounds.point_edge[i] < range && !neighbours(group, mesh_.edges[rod(i)], range))
        out_.edges.push_back(rod(i));
    for (int i = group.other_begin; i < group.other_end; ++i) out_.others.push_back(particle(i));
  }

  // Adds the points that act on rods and particles. Codimensional elements integrate, so that
  // vertices of surfaces carry none of this pressure.
  void add_rods_and_particles(const PointGroup& group, const PairRole& role) {
    const PairRole& codimensional = r_.pairs.codimensional(mesh_.vertex_object[group.point], group.object, region_pair_);
    const double pressure_area = topology().is_codimensional(group.point) ? codimensional_overlap(group) : 0;
    if (pressure_area > 0) {
      begin_point(group, {codimensional.law, codimensional.range, pressure_area});
      list_rods(group, codimensional.range);
      end_point();
    }
    const SafetyBarrier barrier = safety_barrier_of(role);
    const double rest = tributary_area(group.point) - pressure_area;
    if (barrier.law < 0 || !(rest > 0)) return;
    begin_point(group, {barrier.law, barrier.range, rest});
    list_rods(group, barrier.range);
    end_point();
  }
  // Returns the overlap area with rods and particles [m^2]; of two particles each has half.
  double codimensional_overlap(const PointGroup& group) const {
    const double radius = topology().particle_radius(group.point);
    if (radius == 0) return r_.rods.area(group.point, group.object);
    if (group.other_end == group.other_begin) return disc_overlap(radius, r_.surface.rod_width[group.object]);
    const double smaller = std::min(radius, r_.surface.particle_radius[group.object]);
    return M_PI / 2 * smaller * smaller;
  }

  // Returns the weight by size, b^4 / (a^4 + b^4), of a point with area a per vertex against b on the
  // opposite side. Both sides of uniform meshes together count the overlap once; a finer mesh counts
  // nearly all of it. A coarse point, whose area may exceed the overlap, counts little.
  double size_weight(const PairRole& role, int point, const VisiblePatch& patch) const {
    if (!rule_.by_size) return role.area_factor;
    const double own = r_.lagged.area_per_vertex(point, patch.normal), opposite = patch.area_per_vertex;
    return opposite > 0 ? 1 / (1 + std::pow(own / opposite, 4)) : 0;
  }

  // Returns the pressure area; 0 past the overlap boundary, where the safety barrier alone acts.
  double pressure_area(const VisiblePatch& patch, double weight) const {
    return rule_.by_size && patch.overshoot > overshoot_per_size_max * std::sqrt(patch.area) ? 0 : weight * patch.area;
  }

  // Returns the role of a patch, by its seed triangle.
  const PairRole& role_towards(const PointGroup& group, const VisiblePatch& patch) const {
    const int own = mesh_.vertex_object[group.point];
    return r_.pairs.point(own, group.object, r_.pairs.region_pair(own, group.object, std::array{group.point}, mesh_.triangles[patch.seed_triangle]));
  }

  void add_pressure(int g, const PairRole& role) {
    const PointGroup& group = r_.candidates.groups.all[g];
    const VisiblePatches& visible = r_.patches[r_.patches_of_group[g]].visible;
    const SafetyBarrier barrier = safety_barrier_of(role);
    std::array<double, VisiblePatches::count_max> areas{}, size_weights{};
    for (int k = 0; k < visible.count; ++k) {
      size_weights[k] = size_weight(role, group.point, visible.patches[k]);
      areas[k] = pressure_area(visible.patches[k], size_weights[k]);
    }
    const QueryPoint from = finder_.at_vertex(group.point);
    const double range_max = std::max(role.range_max(), barrier.law >= 0 ? barrier.range : 0);
    // A sheet that bends sharply faces its neighbours at less than its thickness.
    const bool thick = within_object(group) && r_.pairs.offset(group.object, group.object) > 0;
    near_.clear();
    for (int i = group.triangle_begin; i < group.triangle_end; ++i) {
      if (!may_come_within(i, range_max)) continue;
      const int patch = thick && neighbours(group, mesh_.triangles[triangle(i)], barrier.range) ? -1 : finder_.patch_of(from, visible, triangle(i));
      near_.push_back({i, patch >= 0 && areas[patch] > 0 ? patch : -1});
    }
    for (int k = 0; k < visible.count; ++k) {
      const PairRole& patch_role = role_towards(group, visible.patches[k]);
      add_patch(group, {patch_role.law, patch_role.range, areas[k]}, k);
      // The safety barrier acts with the remaining weight, so that points of little pressure do not
      // penetrate.
      const double rest = rule_.by_size ? (1 - size_weights[k]) * r_.lagged.tributary_area(group.point) : 0;
      if (barrier.law >= 0 && rest > 0) add_patch(group, {barrier.law, barrier.range, rest}, k);
    }
    if (barrier.law < 0) return;
    begin_point(group, {barrier.law, barrier.range, r_.lagged.tributary_area(group.point)});
    for (const NearTriangle& t : near_)
      if (t.patch < 0 && may_come_within(t.candidate, barrier.range) &&
          !neighbours(group, mesh_.triangles[triangle(t.candidate)], barrier.range))
        out_.triangles.push_back(t.candidate);
    end_point();
  }

  // Adds the points of a vertex of a rod, or of a particle. The safety barrier acts on triangles for
  // which its weight is small.
  void add_codimensional(const PointGroup& group, const PairRole& role) {
    const PairRole& pressure = r_.pairs.codimensional(mesh_.vertex_object[group.point], group.object, region_pair_);
    const double area = r_.lagged.codimensional_area(group.point);
    triangles_.clear();
    for (int i = group.triangle_begin; i < group.triangle_end; ++i) triangles_.push_back(triangle(i));
    std::vector<TriangleWeight>& weights = codimensional_.find(group.point, triangles_, pressure.range);
    normalise_weights(group.point, pressure.range, weights);
    relax_weights(group.point, triangles_, pressure.range, r_.previous_weights, weights, out_.lagged_weights);
    add_weighted(group, {pressure.law, pressure.range, area}, weights, [&](int i, const TriangleWeight& s) {
      return neighbours(group, mesh_.triangles[triangle(i)], pressure.range) ? 0 : s.weight;
    });
    const SafetyBarrier barrier = safety_barrier_of(role);
    if (barrier.law < 0) return;
    add_weighted(group, {barrier.law, barrier.range, area}, weights, [&](int i, const TriangleWeight& s) {
      if (s.weight >= small_weight || neighbours(group, mesh_.triangles[triangle(i)], barrier.range)) return 0.0;
      const double fraction = s.weight / small_weight;
      return 1 - fraction * fraction * (3 - 2 * fraction);
    });
  }
  // Normalises the weights of a point that is close to a surface at several positions of similar
  // direction, because around a rod of projected width w there is area for pi w only, around a
  // particle for four of its cross-sections. Feature f has the overlap count
  //     N_f = sum_g m_g max(0, u_f . u_g),
  // with unit vectors u from the features to the point, and multiplicities m that fade in the outer
  // half of the range. Weights are divided by the mean N_f.
  void normalise_weights(int point, double range, std::vector<TriangleWeight>& weights) {
    const VecX& x = r_.lagged.x();
    const Vec3 p = vertex(x, point);
    near_triangles_.clear();
    for (const int t : triangles_) near_triangles_.push_back(mesh_.triangles[t]);
    feature_directions_.clear();
    for (const PointFeature& f : features_.reduce(x, p, near_triangles_, weights, range)) {
      const Vec3 separation = p - closest_on(x, f, p);
      const double fade = std::clamp(2 * (1 - separation.norm() / range), 0.0, 1.0);
      feature_directions_.emplace_back(f.multiplicity * fade * fade * (3 - 2 * fade), separation.normalized());
    }
    double sum = 0, overlap_count = 0;
    for (const auto& [own, u] : feature_directions_) {
      sum += own;
      for (const auto& [other, v] : feature_directions_) overlap_count += own * other * std::max(0.0, u.dot(v));
    }
    if (sum > 0 && overlap_count > sum)
      for (TriangleWeight& s : weights) s.weight *= sum / overlap_count;
  }
  static Vec3 closest_on(const VecX& x, const PointFeature& f, const Vec3& p) {
    Vec3 a = vertex(x, f.vertices[0]);
    if (f.count() == 1) return a;
    const Vec3 along = (Vec3(vertex(x, f.vertices[1])) - a).normalized();
    if (f.count() == 2) return a + along.dot(p - a) * along;
    const Vec3 normal = along.cross(Vec3(vertex(x, f.vertices[2])) - a).normalized();
    return p - normal.dot(p - a) * normal;
  }
  template <class Weight>
  void add_weighted(const PointGroup& group, const ActingLaw& acting, const std::vector<TriangleWeight>& weights, const Weight& weight_of) {
    begin_point(group, acting);
    const int first = static_cast<int>(out_.weights.size());
    out_.points.back().weight_begin = first;
    for (int i = group.triangle_begin; i < group.triangle_end; ++i) {
      if (!may_come_within(i, acting.range)) continue;
      TriangleWeight s = weights[i - group.triangle_begin];
      s.weight = weight_of(i, s);
      if (!(s.weight > 0)) continue;
      out_.triangles.push_back(i);
      out_.weights.push_back(s);
    }
    end_point();
  }

  const VertexQuadratureRequest& r_;
  const CollisionMesh& mesh_;
  const EarlierVertexQuadrature* const earlier_;
  PatchFinder finder_;
  CodimensionalWeights codimensional_;
  VertexQuadrature out_;
  IntegrationRule rule_;            // of the group
  std::vector<int> laws_;           // of the quadrature points of a group, ascending
  int region_pair_ = -1;            // of the nearest primitive of the group
  std::vector<NearTriangle> near_;  // of a group
  std::vector<int> triangles_;      // of a group
  std::vector<Triangle> near_triangles_;
  WeightedFeatures features_;
  std::vector<std::pair<double, Vec3>> feature_directions_;  // multiplicity, direction to the point
};

}  // namespace

void make_vertex_quadrature(const VertexQuadratureRequest& request, const EarlierVertexQuadrature* earlier, VertexQuadrature& all) {
  constexpr int groups_per_chunk = 64;
  const int n = static_cast<int>(request.candidates.groups.all.size());
  std::vector<VertexQuadrature> chunks(chunk_count(n, groups_per_chunk));
  for_each_chunk(n, [&](int c, int first, int last) {
    QuadratureMaker maker(request, earlier);
    for (int g = first; g < last; ++g) maker.add(g);
    chunks[c] = maker.take();
  }, groups_per_chunk);
  join(chunks, all);
}

}  // namespace tack
