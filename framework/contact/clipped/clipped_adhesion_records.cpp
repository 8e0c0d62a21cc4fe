// What records, probes and checks read of the clipped adhesion.
#include <Eigen/Geometry>
#include <algorithm>

#include "framework/contact/clipped/clipped_adhesion_term.hpp"

namespace tack {

// Returns the unit normal of b, on the side of a if b has two sides.
Vec3 ClippedAdhesionTerm::normal_of_b(const VecX& x, const ClosePair& close) {
  const auto corner = [&](int k) { return vertex(x, close.vertices[k]); };
  const Vec3 normal = (corner(4) - corner(3)).cross(corner(5) - corner(3)).normalized();
  return close.two_sided_b && normal.dot(corner(0) + corner(1) + corner(2) - 3 * corner(3)) < 0 ? Vec3(-normal) : normal;
}

// Returns the gap of the centre of a over the plane of b.
double ClippedAdhesionTerm::mean_gap(const VecX& x, const ClosePair& close) {
  return normal_of_b(x, close).dot((vertex(x, close.vertices[0]) + vertex(x, close.vertices[1]) + vertex(x, close.vertices[2])) / 3 - vertex(x, close.vertices[3]));
}

bool ClippedAdhesionTerm::visit_energies(const VecX& x, const EnergyVisitor& visit) const {
  const std::vector<ClippedIntegral> all = integrals(x);
  for (size_t i = 0; i < all.size(); ++i) visit(close_[i].vertices, all[i].energy);
  return true;
}

// Returns the gradients of the close pairs, which minimisers have mostly asked for already.
const std::vector<Vec18>& ClippedAdhesionTerm::gradients(const VecX& x) const {
  if (gradients_at_.size() == x.size() && gradients_at_ == x) return gradients_;
  keeps_gradients_ = true;
  std::vector<double> all(18 * close_.size());
  derivatives(x, Projection::clamp, all.data(), nullptr);
  return gradients_;
}

// One point per pair of triangles: the centroid of the part of b that is covered, with its area.
void ClippedAdhesionTerm::add_points(const ContactPointsRequest& request, int first_index, ContactPoints& out) const {
  const auto wanted = [&](const ClippedLaw& law) { return request.wanted[law.of_table]; };
  if (std::none_of(laws_.laws().begin(), laws_.laws().end(), wanted)) return;
  const std::vector<int>& object = system_.surface().mesh.vertex_object;
  const std::vector<ClippedIntegral> all = integrals(request.x);
  for (int i = 0; i < pair_count(); ++i) {
    const ClosePair& close = close_[i];
    if (close.pair.whole < 0) continue;
    const ClippedLaw& law = laws_.laws()[close.pair.whole];
    const double area = all[i].area[0] + all[i].area[1] + all[i].area[2];
    if (!wanted(law) || !(area > 0) || !(all[i].gap < law.range)) continue;
    ContactPoint<6> point{close.vertices, {}, normal_of_b(request.x, close), {}, all[i].gap, law.share * area, 0, 3, first_index + i,
                          object[close.vertices[0]], object[close.vertices[3]], law.of_table};
    for (int k = 0; k < 3; ++k) {
      point.coefficients[k] = all[i].area_a[k] / area;
      point.coefficients[3 + k] = -all[i].area[k] / area;
    }
    point.tangents = tangents_of(point.normal);
    out.of<6>().push_back(point);
  }
}

// One point per pair of triangles: the centroids of the parts of both that attract each other.
void ClippedAdhesionTerm::visit_points(const VecX& x, std::string_view, const ForcePointVisitor& visit) const {
  const std::vector<int>& object = system_.surface().mesh.vertex_object;
  const std::vector<ClippedIntegral> all = integrals(x);
  const std::vector<Vec18>& slopes = gradients(x);
  for (int i = 0; i < pair_count(); ++i) {
    const ClosePair& close = close_[i];
    const double area = all[i].area[0] + all[i].area[1] + all[i].area[2];
    if (!(area > 0)) continue;
    ForcePoint point;
    point.object = object[close.vertices[0]];
    point.opposite = object[close.vertices[3]];
    point.vertices = close.vertices;
    point.own_vertex_count = 3;
    std::array<double, 6> coefficients;
    for (int k = 0; k < 3; ++k) {
      coefficients[k] = all[i].area_a[k] / area;
      coefficients[3 + k] = -all[i].area[k] / area;
      point.force -= slopes[i].segment<3>(3 * k);
    }
    point.coefficients = coefficients;
    point.normal = normal_of_b(x, close);
    point.gap = all[i].gap;
    // Laws of regions are differences to that of the whole triangles.
    point.area = close.pair.whole < 0 ? 0 : laws_.laws()[close.pair.whole].share * area;
    point.normal_force = point.force.dot(point.normal);
    visit(point);
  }
}

void ClippedAdhesionTerm::publish(Records& records) const {
  ForceRecord force{"clipped_adhesion", ForceDirection::normal, {"adhesion"}};
  force.add = [this](const VecX& x, std::string_view, VecX& forces) {
    const std::vector<Vec18>& all = gradients(x);
    for (size_t i = 0; i < all.size(); ++i)
      for (int k = 0; k < 6; ++k) vertex(forces, close_[i].vertices[k]) -= all[i].segment<3>(3 * k);
  };
  force.between = [this](const VecX& x, std::string_view, ObjectPair objects) {
    const std::vector<Vec18>& all = gradients(x);
    const std::vector<int>& object = system_.surface().mesh.vertex_object;
    Vec3 sum = Vec3::Zero();
    for (size_t i = 0; i < all.size(); ++i) {
      const int a = object[close_[i].vertices[0]], b = object[close_[i].vertices[3]];
      const int first = a == objects.a && b == objects.b ? 0 : a == objects.b && b == objects.a ? 3 : -1;
      for (int k = first; first >= 0 && k < first + 3; ++k) sum -= all[i].segment<3>(3 * k);
    }
    return sum;
  };
  // Along the normal of b, positive where the vertex is pressed.
  force.add_compressions = [this](const VecX& x, std::string_view, VecX& pressed) {
    const std::vector<Vec18>& all = gradients(x);
    for (size_t i = 0; i < all.size(); ++i) {
      const Vec3 normal = normal_of_b(x, close_[i]);
      for (int k = 0; k < 6; ++k)
        pressed(3 * close_[i].vertices[k]) -= (k < 3 ? 1 : -1) * all[i].segment<3>(3 * k).dot(normal);
    }
  };
  records.add(std::move(force));
  records.add(EnergyRecord{"adhesion", EnergyKind::contact, [this](const VecX& x) { return value(x); }});
}

}  // namespace tack
