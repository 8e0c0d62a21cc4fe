// Merges the stencils of each contact point into one for each direction (contact_points.hpp).
#include <algorithm>
#include <numeric>

#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/contact/stencils/stencil_distance.hpp"
#include "geometry/distance/closest_parameters.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Feature of a contact point: one of its stencils.
struct Feature {
  int contact_point;
  int point, object, law;  // vertex or interior point; object of the feature
  int own_vertex_count;    // of the point: 1, or 3 of an interior point
  std::array<int, 3> own_vertices;
  Vec3 own_coefficients;
  std::array<int, 3> vertices;         // of the feature; the rest is -1
  std::array<double, 3> coefficients;  // of the closest point
  Vec3 normal;                         // unit, from the feature to the point
  double gap, weight;                  // m, m^2
  double force;                        // along the normal [N]; negative for negative weights

  int arity() const { return own_vertex_count + 1 + (vertices[1] >= 0) + (vertices[2] >= 0); }
};
// Sets the geometry and force of a feature. c: the point, then the corners of the feature, which are
// the vertices of the stencil from `first` on.
template <size_t K, size_t N>
void fill_feature(const std::array<Vec3, K>& c, const std::array<int, N>& vertices, const PairLaw& barrier,
                  Feature& f) {
  constexpr size_t first = N - K + 1;
  f.vertices = {-1, -1, -1};
  f.coefficients = {1, 0, 0};
  for (size_t i = 1; i < K; ++i) f.vertices[i - 1] = vertices[first + i - 1];
  if constexpr (K == 3) {
    const double u = project_onto_line(c[0], c[1], c[2]).u;
    f.coefficients = {1 - u, u, 0};
  } else if constexpr (K == 4) {
    const PlaneProjection at = project_onto_triangle(c[0], c[1], c[2], c[3]);
    f.coefficients = {1 - at.u - at.v, at.u, at.v};
  }
  Vec3 separation = c[0];
  for (size_t i = 1; i < K; ++i) separation -= f.coefficients[i - 1] * c[i];
  f.gap = separation.norm();
  f.normal = separation / f.gap;
  f.force = -f.weight * barrier.at(f.gap).slope;
}

class FeatureMerging {
 public:
  FeatureMerging(const ContactPointsRequest& request, ContactPoints& out)
      : object_(request.system.surface().mesh.vertex_object), barriers_(request.system.pairs().laws(LawTerm::barrier)), request_(request), out_(out) {
    const ContactSet& set = request.system.contacts();
    merge<false>(set, set.point_count);
    merge<true>(set, set.interior_point_count);
  }

 private:
  // Merges the features of vertices, or of interior points. points: their number of contact points;
  // stencils that are contact points of their own follow.
  template <bool interior>
  void merge(const ContactSet& set, int points) {
    features_.clear();
    for_each_kind(set, [&](auto kind, const auto& stencils, const double*) {
      using Kind = decltype(kind);
      if constexpr (is_interior<Kind> == interior && !std::is_same_v<Kind, EdgeEdgeKind>) take(stencils, points);
    });
    std::vector<int> end(points + 1, 0);  // per contact point, into features in the order of points
    for (const Feature& f : features_) ++end[f.contact_point + 1];
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<const Feature*> sorted(features_.size());
    for (const Feature& f : features_) sorted[end[f.contact_point]++] = &f;
    auto first = sorted.begin();
    for (int p = 0; p < points; ++p) {
      const auto last = sorted.begin() + end[p];
      if (first != last) split(first, last);
      first = last;
    }
  }

  template <class Stencil>
  void take(const std::vector<Stencil>& stencils, int& points) {
    const size_t before = features_.size();
    std::vector<int> chosen;
    for (size_t i = 0; i < stencils.size(); ++i)
      if (request_.wanted[stencils[i].law]) chosen.push_back(static_cast<int>(i));
    features_.resize(before + chosen.size());
    for (size_t i = 0; i < chosen.size(); ++i) {
      const int point = stencils[chosen[i]].point;
      features_[before + i].contact_point = point < 0 ? points++ : point;
    }
    for_each(static_cast<int>(chosen.size()), [&](int i) {
      const Stencil& s = stencils[chosen[i]];
      Feature& f = features_[before + i];
      take_point(s, f);
      f.law = s.law;
      f.weight = s.weight;
      f.object = object_[s.vertices[f.own_vertex_count]];
      fill_feature(corners(request_.x, s), s.vertices, barriers_[s.law], f);
    });
  }
  template <int K>
  static void take_point(const ContactStencil<K>& s, Feature& f) {
    f.point = s.vertices[0];
    f.own_vertex_count = 1;
    f.own_vertices = {s.vertices[0], -1, -1};
    f.own_coefficients = Vec3::UnitX();
  }
  template <int K>
  static void take_point(const InteriorStencil<K>& s, Feature& f) {
    f.point = s.point;
    f.own_vertex_count = 3;
    f.own_vertices = {s.vertices[0], s.vertices[1], s.vertices[2]};
    f.own_coefficients = s.inside;
  }

  // Makes the contact points of the features first .. last of one: repeatedly the strongest remaining
  // feature, with all features whose normals agree.
  using Features = std::vector<const Feature*>::iterator;
  void split(Features first, Features last) {
    if (last - first > 1)
      std::stable_sort(first, last, [](const Feature* a, const Feature* b) {
        return a->force != b->force ? a->force > b->force : a->gap < b->gap;
      });
    while (first != last) {
      const Feature& strongest = **first;
      auto next = std::next(first);
      if (next != last)
        next = std::stable_partition(next, last, [&](const Feature* f) { return f->normal.dot(strongest.normal) > 0; });
      double force = 0, area = 0;
      for (auto f = first; f != next; ++f) {
        force += (*f)->force * (*f)->normal.dot(strongest.normal);
        area += (*f)->weight;
      }
      if (force > 0 || area > 0)
        with_arity(strongest.arity(), [&]<int K>() { add<K>(strongest, std::max(force, 0.0), std::max(area, 0.0)); });
      first = next;
    }
  }

  template <int K>
  void add(const Feature& f, double force, double area) {
    ContactPoint<K>& c = out_.of<K>().emplace_back();
    for (int i = 0; i < K; ++i) {
      const int j = i - f.own_vertex_count;
      c.vertices[i] = j < 0 ? f.own_vertices[i] : f.vertices[j];
      c.coefficients[i] = j < 0 ? f.own_coefficients[i] : -f.coefficients[j];
    }
    c.normal = f.normal;
    c.tangents = tangents_of(f.normal);
    c.gap = f.gap;
    c.area = area;
    c.normal_force = force;
    c.own_vertex_count = f.own_vertex_count;
    c.point = f.point;
    c.object = object_[f.own_vertices[0]];
    c.opposite = f.object;
    c.law = f.law;
  }

  const std::vector<int>& object_;
  const std::vector<PairLaw>& barriers_;
  const ContactPointsRequest& request_;
  ContactPoints& out_;
  std::vector<Feature> features_;  // of vertices, or of interior points
};

}  // namespace

void add_points_of_features(const ContactPointsRequest& request, ContactPoints& out) { FeatureMerging(request, out); }

}  // namespace tack
