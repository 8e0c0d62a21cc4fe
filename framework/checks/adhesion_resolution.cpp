#include "framework/checks/adhesion_resolution.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/contact/surface/lagged_surface.hpp"
#include "framework/scene/copied_lines.hpp"
#include "framework/world/world.hpp"
#include "geometry/mesh/quality.hpp"

namespace tack {
namespace {

constexpr double tolerated_change = 0.25;  // of the range
constexpr double coarse_fraction_min = 0.5;            // of the impulse

// Returns the change of the gap across a triangle [m], n pointing to the other surface; 0 if the
// triangle faces elsewhere.
double gap_change_across(const std::array<Vec3, 3>& t, bool two_sided, const Vec3& n, double& facing) {
  const Vec3 twice = (t[1] - t[0]).cross(t[2] - t[0]);
  const double area = twice.norm(), cosine = twice.dot(n) / area;
  facing = two_sided ? std::abs(cosine) : -cosine;
  if (!(facing > facing_cosine_min)) return facing = 0;
  return std::sqrt(area * std::max(0.0, 1 - cosine * cosine));
}

// Returns whether interior points of a towards b, or regions of them, are no quadrature points of
// the laws of points: those of clipped adhesion, whose quadrature is exact whatever the change of
// the gap.
bool has_exact_quadrature(const PairTable& pairs, int a, int b) {
  for (int region_pair = -1; region_pair < pairs.region_pair_count(a, b); ++region_pair)
    if (!pairs.point(a, b, region_pair).counts_area) return true;
  return false;
}

}  // namespace

AdhesionResolution::AdhesionResolution(const SceneConfig& scene, const World& world)
    : scene_(scene), world_(world), impulses_(world.contact->pairs().laws().size()) {
  for (const PairLaw& law : world.contact->pairs().laws(LawTerm::adhesion)) adheres_.push_back(!law.laws().empty());
}

// Means over the triangles at a vertex that face the other surface.
AdhesionResolution::Element AdhesionResolution::element_at(int v, const Vec3& n, const VecX& x) const {
  const CollisionMesh& mesh = world_.contact->surface().mesh;
  const SurfaceTopology& topology = world_.contact->lagged_surface().topology();
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
  const PairLaw& adhesion = world_.contact->pairs().laws(LawTerm::adhesion)[law];
  const double tolerated = tolerated_change * (adhesion.range() - adhesion.offset());
  LawImpulse& pulled = impulses_[law];
  pulled.all += impulse;
  if (element.gap_change <= tolerated) return;
  pulled.coarse += impulse;
  pulled.size += impulse * element.size * tolerated / element.gap_change;
  if (pulled.object < 0) pulled.object = object, pulled.other = other;
}

// Returns the element of an interior quadrature point: its triangle, weighted by the area of the point.
AdhesionResolution::Element AdhesionResolution::element_around(const Triangle& triangle, const Vec3& n, double own_area, const VecX& x) {
  double facing = 0;
  const auto c = corners(x, triangle);
  const double area = triangle_area(c[0], c[1], c[2]);
  return {gap_change_across(c, true, n, facing) * std::sqrt(std::min(1.0, own_area / area)), std::sqrt(2 * area)};
}

void AdhesionResolution::examine(const VecX& x, double h) {
  const std::vector<PairLaw>& laws = world_.contact->pairs().laws(LawTerm::adhesion);
  const ContactPoints points = contact_points({*world_.contact, adheres_, x});
  for_each_record(points, [&]<int K>(const ContactPoint<K>& c) {
    if (c.kind() == PointKind::edges || c.gap >= laws[c.law].range()) return;
    if (c.kind() == PointKind::interior && has_exact_quadrature(world_.contact->pairs(), c.object, c.opposite)) return;
    Element element;
    if (c.kind() == PointKind::vertex) element = element_at(c.point, c.normal, x);
    else if constexpr (K > 3) element = element_around({c.vertices[0], c.vertices[1], c.vertices[2]}, c.normal, c.area, x);
    add(c.law, c.area * std::max(0.0, laws[c.law].at(c.gap).slope) * h, element, c.object, c.opposite);
  });
}

std::vector<Warning> AdhesionResolution::warnings() const {
  CopiedLines lines;
  for (const LawImpulse& pulled : impulses_) {
    if (!(pulled.coarse > coarse_fraction_min * pulled.all)) continue;
    const std::string& name = world_.bodies[pulled.object].name;
    lines.add(scene_.objects[pulled.object], WarningKind::coarse_adhesion,
               fmt::format("where '{}' adhered to '{}', the gap changed by more than a quarter of the range from one end of an element to the other "
                           "({:.0f}% of what pulled did so there): its force depends on where vertices happen to be; elements of {:.2g} m would do",
                           name, world_.bodies[pulled.other].name, 100 * pulled.coarse / pulled.all, pulled.size / pulled.coarse));
  }
  return lines.warnings();
}

}  // namespace tack
