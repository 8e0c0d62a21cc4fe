#include "framework/scene/adhesion_resolution.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "framework/contact/contact_term.hpp"
#include "framework/contact/held_surface.hpp"
#include "framework/contact/stencil_kinds.hpp"
#include "framework/scene/copied_lines.hpp"
#include "framework/scene/world.hpp"
#include "geometry/distance/point_edge.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "geometry/mesh/quality.hpp"

namespace tack {
namespace {

constexpr double tolerated_change = 0.25;  // of the range
constexpr double most_of_it = 0.5;            // of the impulse

// From the other surface to the point.
Vec3 separation(const Vec3& p, const std::array<Vec3, 1>& q) { return p - q[0]; }
Vec3 separation(const Vec3& p, const std::array<Vec3, 2>& e) { return point_edge_separation(p, e[0], e[1]); }
Vec3 separation(const Vec3& p, const std::array<Vec3, 3>& t) { return point_triangle_separation(p, t[0], t[1], t[2]); }

// By how much the gap changes across a triangle, the way to the other surface being n; 0 if it looks elsewhere [m].
double gap_change_across(const std::array<Vec3, 3>& t, bool two_sided, const Vec3& n, double& facing) {
  const Vec3 twice = (t[1] - t[0]).cross(t[2] - t[0]);
  const double area = twice.norm(), cosine = twice.dot(n) / area;
  facing = two_sided ? std::abs(cosine) : -cosine;
  if (!(facing > least_cosine)) return facing = 0;
  return std::sqrt(area * std::max(0.0, 1 - cosine * cosine));
}

}  // namespace

AdhesionResolution::AdhesionResolution(const SceneConfig& scene, const World& world)
    : scene_(scene), world_(world), pulled_(world.contact_term->laws(LawPart::adhesion).size()) {}

// Means over the triangles at a vertex of a mesh that look at the other surface.
AdhesionResolution::Element AdhesionResolution::element_at(int v, const Vec3& n, const VecX& x) const {
  const CollisionMesh& mesh = world_.contact->surface().mesh;
  const SurfaceTopology& topology = world_.contact->held().topology();
  Element sum;
  double weight = 0;
  for (const int t : topology.triangles_at(v)) {
    double facing = 0;
    const auto c = corners(x, mesh.triangles[t]);
    sum.gap_change += gap_change_across(c, topology.two_sided(t), n, facing) * facing;
    sum.size += std::sqrt(2 * triangle_area(c[0], c[1], c[2])) * facing;
    weight += facing;
  }
  if (weight > 0) sum.gap_change /= weight, sum.size /= weight;
  return sum;
}

void AdhesionResolution::add(int law, double impulse, const Element& element, int object, int other) {
  const PairLaw& adhesion = world_.contact_term->laws(LawPart::adhesion)[law];
  const double tolerated = tolerated_change * (adhesion.range() - adhesion.offset());
  Pulled& pulled = pulled_[law];
  pulled.all += impulse;
  if (element.gap_change <= tolerated) return;
  pulled.coarse += impulse;
  pulled.size += impulse * element.size * tolerated / element.gap_change;
  if (pulled.object < 0) pulled.object = object, pulled.other = other;
}

template <class Kind, class Stencils>
void AdhesionResolution::look_at(const Stencils& stencils, const VecX& x, double h) {
  const ContactSurface& surface = world_.contact->surface();
  const std::vector<PairLaw>& laws = world_.contact_term->laws(LawPart::adhesion);
  constexpr int first = Kind::first_vertices, others = Kind::arity - first;
  for (const auto& s : stencils) {
    if (!(laws[s.law].range() > laws[s.law].offset())) continue;
    std::array<Vec3, others> feature;
    for (int i = 0; i < others; ++i) feature[i] = vertex(x, s.vertices[first + i]);
    Vec3 p = vertex(x, s.vertices[0]);
    if constexpr (first == 3) p = point_inside(x, {s.vertices[0], s.vertices[1], s.vertices[2]}, s.inside);
    const Vec3 apart = separation(p, feature);
    const double d = apart.norm();
    if (!(d > 0) || d >= laws[s.law].range()) continue;
    const double traction = std::max(0.0, laws[s.law].at(d).slope);
    const Vec3 n = apart / d;
    Element element;
    if constexpr (first == 3) {
      double facing = 0;
      const auto corners_of = corners(x, Triangle{s.vertices[0], s.vertices[1], s.vertices[2]});
      const double area = 2 * triangle_area(corners_of[0], corners_of[1], corners_of[2]), own = 2 * std::abs(s.weight);
      element = {gap_change_across(corners_of, true, n, facing) * std::sqrt(std::min(1.0, own / area)), std::sqrt(area)};
    } else {
      element = element_at(s.vertices[0], n, x);
    }
    add(s.law, std::abs(s.weight) * traction * h, element, surface.mesh.vertex_object[s.vertices[0]],
        surface.mesh.vertex_object[s.vertices[first]]);
  }
}

void AdhesionResolution::look(const VecX& x, double h) {
  const ContactSet& contacts = world_.contact->contacts();
  look_at<PointPointKind>(contacts.point_point, x, h);
  look_at<PointEdgeKind>(contacts.point_edge, x, h);
  look_at<PointTriangleKind>(contacts.point_triangle, x, h);
  look_at<SampleKind<PointPointKind>>(contacts.sample_point, x, h);
  look_at<SampleKind<PointEdgeKind>>(contacts.sample_edge, x, h);
  look_at<SampleKind<PointTriangleKind>>(contacts.sample_triangle, x, h);
}

std::vector<std::string> AdhesionResolution::coarse() const {
  CopiedLines lines;
  for (const Pulled& pulled : pulled_) {
    if (!(pulled.coarse > most_of_it * pulled.all)) continue;
    const std::string& name = world_.bodies[pulled.object].name;
    lines.tell(scene_.objects[pulled.object], "adhesion",
               fmt::format("where '{}' adhered to '{}', the gap changed by more than a quarter of the range from one end of an element to the other "
                           "({:.0f}% of what pulled did so there): its force depends on where vertices happen to be; elements of {:.2g} m would do",
                           name, world_.bodies[pulled.other].name, 100 * pulled.coarse / pulled.all, pulled.size / pulled.coarse));
  }
  return lines.texts();
}

}  // namespace tack
