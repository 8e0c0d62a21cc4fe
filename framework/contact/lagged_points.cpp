// From the features that points see to one contact per point and direction (lagged_contacts.hpp).
#include <algorithm>
#include <tuple>

#include "framework/contact/lagged_contacts.hpp"
#include "framework/contact/stencil_distance.hpp"
#include "geometry/distance/closest_parameters.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// One feature that a point sees.
struct Feature {
  int point, object, law;              // point: a vertex, or the number of vertices plus that of the sample
  int leading;                         // vertices that the point is made of: 1, or 3 of a sample
  std::array<int, 3> lead;
  Vec3 lead_coefficients;
  std::array<int, 3> vertices;         // of the feature; -1 from its end on
  std::array<double, 3> coefficients;  // of the closest point
  Vec3 normal;                         // unit, from the feature to the point
  double gap, weight;                  // m, m^2
  double force;                        // along the normal [N]; negative for negative weights

  int count() const { return 1 + (vertices[1] >= 0) + (vertices[2] >= 0); }
};

// c: the point, then the corners of the feature, which are the vertices of the stencil from `first` on.
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

class PointLag {
 public:
  PointLag(const LagRequest& request)
      : object_(request.system.surface().mesh.vertex_object), request_(request) {
    const ContactSet& set = request.system.contacts();
    take(set.point_point);
    take(set.point_edge);
    take(set.point_triangle);
    take(set.sample_point);
    take(set.sample_edge);
    take(set.sample_triangle);
    std::stable_sort(features_.begin(), features_.end(), [](const Feature& a, const Feature& b) {
      return std::tuple(a.point, a.object, a.law) < std::tuple(b.point, b.object, b.law);
    });
  }

  void contacts(LaggedContacts& out) {
    for (auto first = features_.begin(); first != features_.end();) {
      const auto last = std::find_if_not(first, features_.end(), [&](const Feature& f) {
        return f.point == first->point && f.object == first->object && f.law == first->law;
      });
      split(first, last, out);
      first = last;
    }
  }

 private:
  using Iterator = std::vector<Feature>::iterator;

  template <class Stencil>
  void take(const std::vector<Stencil>& stencils) {
    const size_t before = features_.size();
    std::vector<int> chosen;
    for (size_t i = 0; i < stencils.size(); ++i)
      if (request_.wanted[stencils[i].law]) chosen.push_back(static_cast<int>(i));
    features_.resize(before + chosen.size());
    for_each(static_cast<int>(chosen.size()), [&](int i) {
      const Stencil& s = stencils[chosen[i]];
      Feature& f = features_[before + i];
      lead(s, f);
      f.law = s.law;
      f.weight = s.weight;
      f.object = object_[s.vertices[f.leading]];
      fill_feature(corners(request_.x, s), s.vertices, request_.barriers[s.law], f);
    });
  }
  template <int K>
  void lead(const ContactStencil<K>& s, Feature& f) const {
    f.point = s.vertices[0];
    f.leading = 1;
    f.lead = {s.vertices[0], -1, -1};
    f.lead_coefficients = Vec3::UnitX();
  }
  template <int K>
  void lead(const SampleStencil<K>& s, Feature& f) const {
    f.point = static_cast<int>(object_.size()) + s.sample;
    f.leading = 3;
    f.lead = {s.vertices[0], s.vertices[1], s.vertices[2]};
    f.lead_coefficients = s.inside;
  }

  // The features of one (point, object): the strongest that is left, with all that agree with it, is a
  // contact.
  void split(Iterator first, Iterator last, LaggedContacts& out) {
    std::stable_sort(first, last, [](const Feature& a, const Feature& b) {
      return a.force != b.force ? a.force > b.force : a.gap < b.gap;
    });
    while (first != last) {
      const Feature& strongest = *first;
      const auto next = std::stable_partition(std::next(first), last, [&](const Feature& f) {
        return f.normal.dot(strongest.normal) > 0;
      });
      double force = 0, area = 0;
      for (auto f = first; f != next; ++f) {
        force += f->force * f->normal.dot(strongest.normal);
        area += f->weight;
      }
      if (force > 0 || area > 0) add(strongest, std::max(force, 0.0), std::max(area, 0.0), out);
      first = next;
    }
  }

  void add(const Feature& f, double force, double area, LaggedContacts& out) {
    switch (f.leading + f.count()) {
      case 2: out.twos.push_back(contact<2>(f, force, area)); break;
      case 3: out.threes.push_back(contact<3>(f, force, area)); break;
      case 4: out.fours.push_back(contact<4>(f, force, area)); break;
      case 5: out.fives.push_back(contact<5>(f, force, area)); break;
      default: out.sixes.push_back(contact<6>(f, force, area));
    }
  }
  template <int K>
  static LaggedContact<K> contact(const Feature& f, double force, double area) {
    LaggedContact<K> c{{}, {}, tangents_of(f.normal), f.law, f.leading, force, area};
    for (int i = 0; i < K; ++i) {
      const int j = i - f.leading;
      c.vertices[i] = j < 0 ? f.lead[i] : f.vertices[j];
      c.coefficients[i] = j < 0 ? f.lead_coefficients[i] : -f.coefficients[j];
    }
    return c;
  }

  const std::vector<int>& object_;
  const LagRequest& request_;
  std::vector<Feature> features_;
};

}  // namespace

void lag_points(const LagRequest& request, LaggedContacts& out) { PointLag(request).contacts(out); }

}  // namespace tack
