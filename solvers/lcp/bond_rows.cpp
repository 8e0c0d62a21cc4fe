#include "solvers/lcp/bond_rows.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/surface/lagged_surface.hpp"

namespace tack {

BondStiffness bond_stiffness(const BondTerm& bonds, int i, const Vec3& at, double h) {
  const BondLaw& law = bonds.law_of(i);
  const double d = law.resists_pressing() ? at[0] : std::max(at[0], 0.0), area = bonds.list().bonds()[i].area;
  const BondSample sample = law.at(d, at.tail<2>().squaredNorm(), bonds.list().variables(i), {h, bonds.site(i)});
  return {area * (d != 0 ? sample.by_d / d : sample.by_dd), area * 2 * sample.by_s};
}

void add_bond_rows(const BondTerm& bonds, int i, const VecX& x, const VecX& end, const LinearizedStep& step, Rows& rows, GaussSeidel& sweeps) {
  const Bond& bond = bonds.list().bonds()[i];
  const BondStiffness fresh = bond_stiffness(bonds, i, Vec3::Zero(), step.h());
  if (!(fresh.along > 0)) return;
  Mat3 frame;
  frame << bond.normal, tangents_of(bond.normal);
  const Opening from = opening_of(bond, x), to = opening_of(bond, end);
  RowUnit unit;
  unit.first = rows.count();
  unit.rows = fresh.across > 0 ? 3 : 1;
  unit.bond = i;
  unit.resists_compression = bonds.law_of(i).resists_pressing();
  unit.start = Vec3(from.d, frame.col(1).dot(from.u), frame.col(2).dot(from.u));
  unit.free = (Vec3(to.d, frame.col(1).dot(to.u), frame.col(2).dot(to.u)) - unit.start) / step.h();
  for (int k = 0; k < unit.rows; ++k) {
    for_each_vertex(bond, from, frame.col(k), [&](int v, const Vec3& along) { rows.add(step.dofs(), bond.vertices[v], along); });
    rows.finish();
  }
  const BondStiffness k = bond_stiffness(bonds, i, unit.start, step.h());
  sweeps.add(unit, -step.h() * Vec3(k.along * (unit.resists_compression ? unit.start[0] : std::max(unit.start[0], 0.0)), k.across * unit.start[1], k.across * unit.start[2]));
}

std::vector<double> bond_pressures(const BondTerm& bonds, const std::vector<ContactRow>& contacts, const ContactSystem& system) {
  // Normal force on a vertex, by pair of objects.
  struct Pushed {
    int vertex, other;
    Vec3 force;
  };
  std::vector<Pushed> all;
  for (const ContactRow& c : contacts) {
    const double normal = c.normal.dot(c.force);
    if (!(normal > 0)) continue;
    for (int k = 0; k < 4; ++k)
      if (c.coefficients[k] != 0) all.push_back({c.vertices[k], k < c.own ? c.opposite : c.object, c.coefficients[k] * normal * c.normal});
  }
  std::stable_sort(all.begin(), all.end(), [](const Pushed& a, const Pushed& b) { return a.vertex < b.vertex; });
  std::vector<double> pressures;
  for (const Bond& bond : bonds.list().bonds()) {
    double pressure = 0;
    for (int v = 0; v < bond.site_count; ++v) {
      auto at = std::lower_bound(all.begin(), all.end(), bond.vertices[v], [](const Pushed& p, int vertex) { return p.vertex < vertex; });
      double force = 0;
      for (; at != all.end() && at->vertex == bond.vertices[v]; ++at)
        if (at->other == bond.b) force += std::max(0.0, at->force.dot(bond.normal));
      const double area = system.lagged_surface().tributary_area(bond.vertices[v]);
      if (area > 0) pressure += bond.c[v] * force / area;
    }
    pressures.push_back(pressure);
  }
  return pressures;
}

}  // namespace tack
