// Forces of bonds on their sites, on vertices and between objects, for records and fields.
#include "framework/bond/bond_term.hpp"
#include "framework/bond/bond_traction.hpp"
#include "geometry/parallel.hpp"

namespace tack {

std::vector<Vec3> BondTerm::site_forces(const VecX& x, LawTerm term) const {
  ensure_frames(x);
  std::vector<Vec3> pulls(list_.size());
  for_each(list_.size(), [&](int i) {
    const Bond& bond = list_.bonds()[i];
    const Opening o = opening_of(bond, x);
    Vec3 all;
    double along;  // the normal
    if (law_of(i).directed()) {
      const DirectedSample sample = directed_sample(i, o);
      all = traction(sample, frame_of(bond, sites_[i])), along = sample.gradient[0];
    } else {
      const BondSample sample = law_of(i).at(o.d, o.s, list_.variables(i), step_of(i));
      all = traction(sample, bond, o), along = sample.by_d;
    }
    const Vec3 pressing = o.d < 0 ? Vec3(along * bond.normal) : Vec3(Vec3::Zero());
    pulls[i] = -bond.area * (term == LawTerm::all ? all : term == LawTerm::barrier ? pressing : Vec3(all - pressing));
  });
  return pulls;
}

VecX BondTerm::forces(const VecX& x, LawTerm term, std::optional<ObjectPair> only) const {
  VecX force = VecX::Zero(x.size());
  const std::vector<Vec3> pulled = site_forces(x, term);
  for (int k = 0; k < list_.size(); ++k) {
    const Bond& b = list_.bonds()[k];
    if (only && !b.between(only->a, only->b)) continue;
    for_each_vertex(b, opening_of(b, x), pulled[k], [&](int i, const Vec3& of_vertex) { vertex(force, b.vertices[i]) += of_vertex; });
  }
  return force;
}

VecX BondTerm::compressions(const VecX& x, LawTerm term) const {
  VecX pressed = VecX::Zero(x.size());
  const std::vector<Vec3> pulled = site_forces(x, term);
  for (int k = 0; k < list_.size(); ++k) {
    const Bond& b = list_.bonds()[k];
    for (int i = 0; i < b.count(); ++i) pressed(3 * b.vertices[i]) += (i < b.site_count ? b.c[i] : -b.c[i]) * pulled[k].dot(b.normal);
  }
  return pressed;
}

Vec3 BondTerm::force_between(const VecX& x, LawTerm term, ObjectPair pair) const {
  Vec3 sum = Vec3::Zero();
  const std::vector<Vec3> pulled = site_forces(x, term);
  for (int k = 0; k < list_.size(); ++k) {
    const Bond& b = list_.bonds()[k];
    if (b.between(pair.a, pair.b)) sum += b.a == pair.a ? pulled[k] : Vec3(-pulled[k]);
  }
  return sum;
}

}  // namespace tack
