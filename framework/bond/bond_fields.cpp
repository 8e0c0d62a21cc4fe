#include "framework/bond/bond_fields.hpp"

#include <cmath>
#include <limits>

#include "framework/core/published_field.hpp"

namespace tack {
namespace {

// Calls act(vertex, its fraction of the bond's area [m^2], index of the bond).
template <class Act>
void for_each_vertex_area(const BondList& list, const Act& act) {
  for (int k = 0; k < list.size(); ++k) {
    const Bond& b = list.bonds()[k];
    for (int i = 0; i < b.count(); ++i) act(b.vertices[i], b.area * std::abs(b.c[i]), k);
  }
}

VecX areas_of(const BondList& list, Eigen::Index vertices) {
  VecX areas = VecX::Zero(vertices);
  for_each_vertex_area(list, [&](int v, double area, int) { areas(v) += area; });
  return areas;
}

class BondIntensity : public PublishedField {};
class BondTraction : public PublishedField {
  const char* unit() const override { return "Pa"; }
};
TACK_REGISTER(PublishedField, BondIntensity, "bond_intensity", "Mean intensity of bonds: 1 if all are intact; not a number without bonds.", "");
TACK_REGISTER(PublishedField, BondTraction, "bond_traction", "Magnitude of the bond force per area.", "");

}  // namespace

VecX bond_intensities(const BondTerm& bonds, Eigen::Index vertices) {
  const BondList& list = bonds.list();
  const VecX areas = areas_of(list, vertices);
  VecX sum = VecX::Zero(areas.size());
  for_each_vertex_area(list, [&](int v, double area, int k) {
    sum(v) += area * bonds.intensity(k);
  });
  for (Eigen::Index v = 0; v < sum.size(); ++v) sum(v) = areas(v) > 0 ? sum(v) / areas(v) : std::numeric_limits<double>::quiet_NaN();
  return sum;
}

VecX bond_tractions(const BondTerm& bonds, const VecX& x) {
  const VecX areas = areas_of(bonds.list(), x.size() / 3), forces = bonds.forces(x, LawTerm::adhesion);
  VecX tractions = VecX::Zero(areas.size());
  for (Eigen::Index v = 0; v < areas.size(); ++v)
    if (areas(v) > 0) tractions(v) = vertex(forces, static_cast<int>(v)).norm() / areas(v);
  return tractions;
}

void BondTerm::visit_points(const VecX& x, std::string_view summand, const ForcePointVisitor& visit) const {
  const std::vector<Vec3> pulled = site_forces(x, law_term(summand));
  for (int k = 0; k < list_.size(); ++k) {
    const Bond& b = list_.bonds()[k];
    const size_t count = static_cast<size_t>(b.count());
    ForcePoint point;
    point.object = b.a;
    point.opposite = b.b;
    point.vertices = {b.vertices.data(), count};
    point.coefficients = {b.c.data(), count};
    point.own_vertex_count = b.site_count;
    point.normal = b.normal;
    point.gap = b.normal.dot(point.point(x) - point.opposite_point(x));
    point.area = b.area;
    point.force = pulled[k];
    point.normal_force = point.force.dot(point.normal);
    visit(point);
  }
}

}  // namespace tack
