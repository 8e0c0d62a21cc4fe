#include "framework/world/local_lengths.hpp"

#include <limits>

#include "framework/contact/contact_system.hpp"
#include "geometry/broad_phase/candidate_kinds.hpp"
#include "geometry/distance/squared_distance.hpp"
#include "geometry/mesh/quality.hpp"

namespace tack {
namespace {

class Lengths {
 public:
  Lengths(const World& world, const VecX& x)
      : world_(world), x_(x),
        lengths_(VecX::Constant(world.mass.size(), std::numeric_limits<double>::infinity())) {
    for (const Body& body : world.bodies) add_elements(body);
    for (const UnknownGroup& group : world.unknowns)
      if (group.length > 0) lower(group.vertices, group.length);
    if (world.contact) add_gaps(world.contact->surface().mesh, world.contact->candidates());
    // Vertices that others depend on are limited by these others, too.
    const std::vector<int>& dependents = world.dofs.dependents();
    for (size_t k = 0; k < dependents.size(); ++k)
      for (const DofMap::WeightedIndex& entry : world.dofs.independents(static_cast<int>(k)))
        lower(std::array{entry.index}, lengths_(dependents[k]) / std::max(1.0, 4 * std::abs(entry.weight)));
  }
  const VecX& all() const { return lengths_; }

 private:
  template <class Element>
  void lower(const Element& element, double length) {
    for (const int v : element) lengths_(v) = std::min(lengths_(v), length);
  }
  Vec3 rest(int v) const { return vertex(world_.rest, v); }

  void add_triangle(const Triangle& t) {
    const Vec3 a = rest(t[0]), b = rest(t[1]), c = rest(t[2]);
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    lower(t, 2 * triangle_area(a, b, c) / longest);
  }
  void add_tet(const Tet& t) {
    double largest = 0;
    for (int i = 0; i < 4; ++i)
      largest = std::max(largest, triangle_area(rest(t[i]), rest(t[(i + 1) % 4]), rest(t[(i + 2) % 4])));
    lower(t, 3 * std::abs(tet_volume(rest(t[0]), rest(t[1]), rest(t[2]), rest(t[3]))) / largest);
  }
  void add_elements(const Body& body) {
    for (const Tet& t : body.tets) add_tet(t);
    for (const Triangle& t : body.triangles) add_triangle(t);
    for (const Edge& e : body.edges) lower(e, (rest(e[1]) - rest(e[0])).norm());
    if (body.radius > 0) lower(body.points, body.radius);
  }

  void add_gaps(const CollisionMesh& mesh, const Candidates& candidates) {
    for_each_kind(mesh, candidates, [&](const auto& kind) {
      for (const auto& pair : kind.pairs) {
        const auto& first = kind.first(pair);
        const auto& second = kind.second(pair);
        const double distance = std::sqrt(squared_distance(corners(x_, first), corners(x_, second)));
        lower(first, distance);
        lower(second, distance);
      }
    });
  }

  const World& world_;
  const VecX& x_;
  VecX lengths_;
};

}  // namespace

VecX local_lengths(const World& world, const VecX& x) {
  VecX lengths = Lengths(world, x).all();
  // Particles without neighbours get the smallest length of the others, or a millimetre.
  const double usual = lengths.minCoeff();
  for (double& l : lengths)
    if (!std::isfinite(l)) l = std::isfinite(usual) ? usual : 1e-3;
  return lengths;
}

}  // namespace tack
