// From the features that points see to one contact per point and direction (lagged_contacts.hpp).
#include <algorithm>

#include "framework/assembly/parallel.hpp"
#include "framework/contact/lagged_contacts.hpp"
#include "geometry/distance/closest_parameters.hpp"

namespace tack {
namespace {

// One feature that a point sees.
struct Feature {
  int point, object, law;
  std::array<int, 3> vertices;         // of the feature; -1 from its end on
  std::array<double, 3> coefficients;  // of the closest point
  Vec3 normal;                         // unit, from the feature to the point
  double gap, weight;                  // m, m^2
  double force;                        // along the normal [N]; negative for negative weights

  int count() const { return 1 + (vertices[1] >= 0) + (vertices[2] >= 0); }
};

template <int K>
void fill_feature(const VecX& x, const ContactStencil<K>& s, const PairLaw& barrier, Feature& f) {
  const Vec3 p = vertex(x, s.vertices[0]);
  f.vertices = {-1, -1, -1};
  f.coefficients = {1, 0, 0};
  for (int i = 1; i < K; ++i) f.vertices[i - 1] = s.vertices[i];
  if constexpr (K == 3) {
    const double u = project_onto_line(p, vertex(x, s.vertices[1]), vertex(x, s.vertices[2])).u;
    f.coefficients = {1 - u, u, 0};
  } else if constexpr (K == 4) {
    const PlaneProjection at =
        project_onto_triangle(p, vertex(x, s.vertices[1]), vertex(x, s.vertices[2]), vertex(x, s.vertices[3]));
    f.coefficients = {1 - at.u - at.v, at.u, at.v};
  }
  Vec3 separation = p;
  for (int i = 1; i < K; ++i) separation -= f.coefficients[i - 1] * vertex(x, s.vertices[i]);
  f.point = s.vertices[0];
  f.law = s.law;
  f.gap = separation.norm();
  f.normal = separation / f.gap;
  f.weight = s.weight;
  f.force = -s.weight * barrier.at(f.gap).slope;
}

class PointLag {
 public:
  PointLag(const LagRequest& request)
      : object_(request.system.surface().mesh.vertex_object), request_(request) {
    const ContactSet& set = request.system.contacts();
    take(set.point_point);
    take(set.point_edge);
    take(set.point_triangle);
    std::stable_sort(features_.begin(), features_.end(), [](const Feature& a, const Feature& b) {
      return std::pair(a.point, a.object) < std::pair(b.point, b.object);
    });
  }

  void contacts(LaggedContacts& out) {
    for (auto first = features_.begin(); first != features_.end();) {
      const auto last = std::find_if_not(first, features_.end(), [&](const Feature& f) {
        return f.point == first->point && f.object == first->object;
      });
      split(first, last, out);
      first = last;
    }
  }

 private:
  using Iterator = std::vector<Feature>::iterator;

  template <int K>
  void take(const ContactStencils<K>& stencils) {
    const size_t before = features_.size();
    std::vector<int> chosen;
    for (size_t i = 0; i < stencils.size(); ++i)
      if (request_.wanted[stencils[i].law]) chosen.push_back(static_cast<int>(i));
    features_.resize(before + chosen.size());
    for_each(static_cast<int>(chosen.size()), [&](int i) {
      const ContactStencil<K>& s = stencils[chosen[i]];
      Feature& f = features_[before + i];
      fill_feature(request_.x, s, request_.barriers[s.law], f);
      f.object = object_[s.vertices[1]];
    });
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
    switch (f.count()) {
      case 1: out.twos.push_back(contact<2>(f, force, area)); break;
      case 2: out.threes.push_back(contact<3>(f, force, area)); break;
      default: out.fours.push_back(contact<4>(f, force, area));
    }
  }
  template <int K>
  static LaggedContact<K> contact(const Feature& f, double force, double area) {
    LaggedContact<K> c{{}, {}, tangents_of(f.normal), f.law, 1, force, area};
    c.vertices[0] = f.point;
    c.coefficients[0] = 1;
    for (int i = 1; i < K; ++i) {
      c.vertices[i] = f.vertices[i - 1];
      c.coefficients[i] = -f.coefficients[i - 1];
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
