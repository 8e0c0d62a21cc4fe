#include "geometry/meshing/tetrahedralize.hpp"

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/refine_mesh_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include "geometry/mesh/quality.hpp"
#include "geometry/meshing/cgal_mesh.hpp"
#include "geometry/meshing/defects.hpp"
#include "geometry/meshing/mesh_quality.hpp"
#include "geometry/meshing/surface_distance.hpp"
#include "geometry/meshing/triangle_surface.hpp"

namespace tack {
namespace {

using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<CgalKernel, CgalMesh>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

constexpr double degrees = 180 / std::numbers::pi;
constexpr int seeds_per_patch = 20;

// Lengths with their defaults filled in.
struct Sizes {
  double inside, surface, crease, deviation;  // [m]
};

// The sharp edges that the domain has found.
class Creases {
 public:
  explicit Creases(const Domain& domain) {
    const CgalMesh& m = domain.polyhedra()[0];
    const auto sharp = get(CGAL::edge_is_feature, m);
    for (const auto e : m.edges())
      if (get(sharp, e)) segments_.emplace_back(m.point(m.vertex(e, 0)), m.point(m.vertex(e, 1)));
    tree_.insert(segments_.begin(), segments_.end());
    if (!segments_.empty()) tree_.accelerate_distance_queries();
  }
  Creases(const Creases&) = delete;
  Creases& operator=(const Creases&) = delete;
  double distance(const CgalPoint& p) const {
    return segments_.empty() ? std::numeric_limits<double>::infinity() : std::sqrt(tree_.squared_distance(p));
  }

 private:
  using Segments = std::vector<CgalKernel::Segment_3>;
  Segments segments_;
  CGAL::AABB_tree<CGAL::AABB_traits<CgalKernel, CGAL::AABB_segment_primitive<CgalKernel, Segments::const_iterator>>> tree_;
};

// As short as the edges of creases beside them, and longer with the distance: long ones beside short ones make slivers
// that cannot be removed, as nothing moves there.
struct GradedSize {
  using FT = CgalKernel::FT;
  using Point_3 = CgalPoint;
  using Index = Domain::Index;

  const Creases* creases;
  double crease, most, factor;
  FT operator()(const Point_3& p, int, const Index&) const {
    return factor * (crease < most ? std::min(most, crease + 0.5 * creases->distance(p)) : most);
  }
};

// Edges come out shorter than CGAL's bounds, which are radii of circumscribed balls and not reached by most: the
// factors make the mean edge about as long as asked.
Criteria criteria(const Sizes& s, double radius_edge, const Creases& creases) {
  namespace p = CGAL::parameters;
  return Criteria(p::edge_size = s.crease, p::facet_angle = 25, p::facet_size = GradedSize{&creases, s.crease, s.surface, 0.67},
                  p::facet_distance = s.deviation, p::cell_radius_edge_ratio = radius_edge,
                  p::cell_size = GradedSize{&creases, s.crease, s.inside, 0.75});
}

// Some vertices of a patch, spread over it: each next one is farthest from those before.
std::vector<CgalPoint> spread(const std::vector<CgalPoint>& points) {
  std::vector<CgalPoint> chosen = {points[0]};
  std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
  while (chosen.size() < seeds_per_patch) {
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      distance[i] = std::min(distance[i], CGAL::squared_distance(points[i], chosen.back()));
      if (distance[i] > distance[farthest]) farthest = i;
    }
    if (!(distance[farthest] > 0)) break;
    chosen.push_back(points[farthest]);
  }
  return chosen;
}

// A smooth part that no initial point has hit is not meshed: gives each such patch some points of its own. Returns
// whether there was one.
bool seed_missed_patches(const Domain& domain, Complex& complex) {
  std::set<int> met;
  for (auto f = complex.facets_in_complex_begin(); f != complex.facets_in_complex_end(); ++f)
    met.insert(complex.surface_patch_index(*f));
  const CgalMesh& m = domain.polyhedra()[0];
  const auto patch = get(CGAL::face_patch_id_t<int>(), m);
  std::map<int, std::vector<CgalPoint>> missed;
  for (const auto f : m.faces())
    if (!met.contains(get(patch, f)))
      for (const auto v : m.vertices_around_face(m.halfedge(f))) missed[get(patch, f)].push_back(m.point(v));
  for (const auto& [id, points] : missed)
    for (const CgalPoint& x : spread(points)) {
      const auto v = complex.triangulation().insert(Triangulation::Weighted_point(x));
      if (complex.in_dimension(v) >= 0 && complex.in_dimension(v) < 2) continue;  // on a crease already
      complex.set_dimension(v, 2);
      complex.set_index(v, domain.index_from_surface_patch_index(id));
    }
  return !missed.empty();
}

Mesh tets_of(const Complex& complex) {
  Mesh mesh;
  std::map<Triangulation::Vertex_handle, int> numbers;  // by time stamps, not addresses: ordered alike in every run
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    Tet tet{};
    for (int i = 0; i < 4; ++i) {
      const auto v = cell->vertex(i);
      const auto [number, is_new] = numbers.emplace(v, static_cast<int>(mesh.vertices.size()));
      if (is_new) mesh.vertices.emplace_back(v->point().x(), v->point().y(), v->point().z());
      tet[i] = number->second;
    }
    mesh.tets.push_back(tet);
  }
  return mesh;
}

Mesh mesh_inside(const CgalMesh& surface, const Sizes& sizes, const TetrahedralizeOptions& o) {
  namespace p = CGAL::parameters;
  CGAL::get_default_random() = CGAL::Random(0);
  Domain domain(surface);
  domain.detect_features(o.crease_angle * degrees);
  const Creases creases(domain);
  const Criteria bounds = criteria(sizes, o.radius_edge, creases);
  Complex complex = CGAL::make_mesh_3<Complex>(domain, bounds, p::manifold(), p::no_perturb(), p::no_exude());
  if (seed_missed_patches(domain, complex))
    CGAL::refine_mesh_3(complex, domain, bounds, p::manifold(), p::no_perturb(), p::no_exude());
  const double aim = std::max(12.0, o.dihedral_angle * degrees + 1);
  CGAL::perturb_mesh_3(complex, domain, p::time_limit = 0, p::sliver_bound = aim);
  CGAL::exude_mesh_3(complex, p::time_limit = 0, p::sliver_bound = aim);
  return tets_of(complex);
}

struct Deviation {
  SurfaceDistance from_input, from_tets;
  double largest() const { return std::max(from_input.largest, from_tets.largest); }
};

Deviation deviation_of(const Mesh& surface, const Mesh& tets, double spacing) {
  const Mesh border = triangle_surface(tets, "tets");
  return {distance_from_to(surface, border, spacing), distance_from_to(border, surface, spacing)};
}

struct Attempt {
  Mesh tets;
  Deviation deviation;
  AngleHistogram angles;

  bool keeps(double asked, const TetrahedralizeOptions& o) const {
    return !tets.tets.empty() && deviation.largest() <= asked && angles.smallest >= o.dihedral_angle * degrees;
  }
  bool better_than(const Attempt& other, double asked) const {
    const double excess = std::max(1.0, deviation.largest() / asked), others = std::max(1.0, other.deviation.largest() / asked);
    return excess < others || (excess == others && angles.smallest > other.angles.smallest);
  }
};

void require_whole(const Mesh& tets, const std::string& name) {
  if (tets.tets.empty())
    throw InputError(name + ": no tet came out; ask for shorter edges");
  const SurfaceDefects defects = find_defects(triangle_surface(tets, name), false);
  if (defects.closed() && defects.manifold()) return;
  std::string text = name + ": the surface of the tets is no closed manifold; ask for shorter edges, or a smaller deviation:";
  for (const std::string& line : list_defects(defects)) text += "\n  " + line;
  throw InputError(text);
}

}  // namespace

Mesh tetrahedralize(const Mesh& mesh, const TetrahedralizeOptions& o, const std::string& name, Notes& notes) {
  const Mesh surface = triangle_surface(mesh, name);
  require_solid(surface, name);
  const double on_surface = o.surface_edge_length.value_or(o.edge_length), asked = o.deviation.value_or(0.1 * on_surface);
  Sizes sizes{o.edge_length, on_surface, on_surface, 0.7 * asked};
  const double volume = enclosed_volume_of(surface);
  refuse_too_short_edges(surface, sizes.surface, name);
  refuse_too_many_triangles(volume / (std::pow(sizes.inside, 3) / (6 * std::sqrt(2.0))), name, "ask for longer edges");
  const CgalMesh m = to_cgal(surface);
  Attempt best;
  // CGAL bounds the distance from the centre of each face to the surface, and that of curved creases not at all: what
  // is measured tells how much finer they have to be, the sagitta of a crease growing with the square of its edges.
  // Slivers that are left are beside creases with edges too long for the curvature around: CGAL protects them by balls
  // in which nothing is refined.
  for (int attempt = 0; attempt < 5 && !best.keeps(asked, o); ++attempt) {
    Attempt now;
    now.tets = mesh_inside(m, sizes, o);
    require_whole(now.tets, name);
    now.deviation = deviation_of(surface, now.tets, asked);
    now.angles = dihedral_angles(now.tets);
    if (const double excess = now.deviation.largest() / asked; excess > 1) {
      sizes.deviation *= 0.8 / excess;
      sizes.crease *= std::sqrt(0.8 / excess);
    } else {
      sizes.crease *= 0.7;
    }
    if (attempt == 0 || now.better_than(best, asked)) best = std::move(now);
  }
  const Mesh& tets = best.tets;
  const Deviation& deviation = best.deviation;
  const double made = total_volume(tets);
  notes.push_back(fmt::format("{} triangles filled with {} tets; volume {:.8g} m^3, {:+.3g} % of the surface's", surface.triangles.size(),
                              tets.tets.size(), made, 100 * (made / volume - 1)));
  notes.push_back(fmt::format("distance from the old surface to the new: at most {:.3g} m, rms {:.2g} m; back: at most {:.3g} m, rms "
                              "{:.2g} m", deviation.from_input.largest, deviation.from_input.rms, deviation.from_tets.largest,
                              deviation.from_tets.rms));
  if (deviation.largest() > asked) {
    const SurfaceDistance& worst =
        deviation.from_input.largest > deviation.from_tets.largest ? deviation.from_input : deviation.from_tets;
    notes.push_back(fmt::format("warning: that is more than the {:.3g} m asked for, at ({:.4g}, {:.4g}, {:.4g}); ask for shorter edges, "
                                "or a smaller crease_angle", asked, worst.place[0], worst.place[1], worst.place[2]));
  }
  if (const AngleHistogram& angles = best.angles; angles.smallest < o.dihedral_angle * degrees)
    notes.push_back(fmt::format("warning: the dihedral angle {:.3g} degrees of tet {} at ({:.4g}, {:.4g}, {:.4g}) is below the {:.3g} asked "
                                "for; ask for shorter edges, or remesh the surface first", angles.smallest, angles.worst, angles.place[0],
                                angles.place[1], angles.place[2], o.dihedral_angle * degrees));
  return std::move(best.tets);
}

}  // namespace tack
