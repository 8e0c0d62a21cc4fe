#include "geometry/meshing/tetrahedralize.hpp"

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_3/Mesher_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/make_mesh_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include "geometry/mesh/quality.hpp"
#include "geometry/meshing/cgal_mesh.hpp"
#include "geometry/meshing/defects.hpp"
#include "geometry/mesh/mesh_quality.hpp"
#include "geometry/meshing/mesh_warnings.hpp"
#include "geometry/meshing/surface_deviation.hpp"
#include "geometry/mesh/triangle_surface.hpp"

namespace tack {
namespace {

using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<CgalKernel, CgalMesh>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

}  // namespace
}  // namespace tack

// Without this specialisation, CGAL writes files to the working directory before it reports an error.
template <>
struct CGAL::Dump_c3t3<tack::Complex, true> {
  void dump_c3t3(const tack::Complex&, const std::string&) const {}
};

namespace tack {
namespace {

constexpr double degrees = 180 / std::numbers::pi;
constexpr double no_crease = std::numbers::pi;
constexpr int seeds_per_patch = 20;

// Target lengths, with defaults.
struct Sizes {
  double inside, surface, crease, deviation;  // [m]
};

// Sharp edges that the domain has detected.
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
  bool none() const { return segments_.empty(); }
  double distance(const CgalPoint& p) const {
    return segments_.empty() ? std::numeric_limits<double>::infinity() : std::sqrt(tree_.squared_distance(p));
  }

 private:
  using Segments = std::vector<CgalKernel::Segment_3>;
  Segments segments_;
  CGAL::AABB_tree<CGAL::AABB_traits<CgalKernel, CGAL::AABB_segment_primitive<CgalKernel, Segments::const_iterator>>> tree_;
};

// Edge length that grows with the distance from creases. Long edges beside short crease edges make slivers that cannot be
// removed, because vertices of creases do not move.
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

// Returns CGAL's criteria. Its bounds limit circumradii, which most elements do not reach; the factors make the mean edge
// about as long as requested.
Criteria criteria(const Sizes& s, double radius_edge, const Creases& creases) {
  namespace p = CGAL::parameters;
  return Criteria(p::edge_size = s.crease, p::facet_angle = 25, p::facet_size = GradedSize{&creases, s.crease, s.surface, 0.67},
                  p::facet_distance = s.deviation, p::cell_radius_edge_ratio = radius_edge,
                  p::cell_size = GradedSize{&creases, s.crease, s.inside, 0.75});
}

// Returns vertices spread over a patch: each one is the farthest from the previous ones.
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

// Adds points to smooth patches without an initial point, which would not be meshed. Returns true if there were any.
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
      if (v == Triangulation::Vertex_handle()) continue;  // inside a ball that protects a crease
      if (complex.in_dimension(v) >= 0 && complex.in_dimension(v) < 2) continue;  // on a crease already
      complex.set_dimension(v, 2);
      complex.set_index(v, domain.index_from_surface_patch_index(id));
    }
  return !missed.empty();
}

Mesh tets_of(const Complex& complex) {
  Mesh mesh;
  std::map<Triangulation::Vertex_handle, int> numbers;  // ordered by time stamps, not addresses: equal in every run
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

// Runs CGAL's refinement step by step; returns false if it does not end. Where creases are so close that the balls which protect
// them touch, the surface beside them cannot become manifold: the same point falls into a ball again and again, or points are
// added without end.
bool refine(Complex& complex, const Domain& domain, const Criteria& bounds, std::size_t most_vertices) {
  complex.clear_cells_and_facets_from_c3t3();
  CGAL::Mesh_3::Mesher_3<Complex, Criteria, Domain> mesher(complex, domain, bounds, CGAL::parameters::manifold().mesh_topology);
  try {
    mesher.initialize();
    std::size_t vertices = 0, idle = 0;
    while (!mesher.is_algorithm_done()) {
      mesher.one_step();
      const std::size_t now = complex.triangulation().number_of_vertices();
      idle = now == vertices ? idle + 1 : 0;
      vertices = now;
      if (vertices > most_vertices || idle > 1000 + vertices) return false;
    }
  } catch (const CGAL::Failure_exception&) {  // the same point twice
    return false;
  }
  complex.clear_manifold_info();
  return true;
}

bool fills_manifold(const Mesh& tets) {
  if (tets.tets.empty()) return false;
  const SurfaceDefects defects = find_defects(triangle_surface(tets, "tets"), false);
  return defects.closed() && defects.manifold();
}

// Returns the refined complex as tets, slivers perturbed and exuded. Refinement ends with a manifold surface, but perturbation moves
// vertices of the surface without regard to it, and round-off decides whether two of its edges then meet. A step that makes the
// surface no manifold is left out.
Mesh without_slivers(Complex& complex, const Domain& domain, double aim) {
  namespace p = CGAL::parameters;
  Complex refined(complex);
  CGAL::perturb_mesh_3(complex, domain, p::time_limit = 0, p::sliver_bound = aim);
  CGAL::exude_mesh_3(complex, p::time_limit = 0, p::sliver_bound = aim);
  Mesh tets = tets_of(complex);
  if (fills_manifold(tets)) return tets;
  const Mesh with_slivers = tets_of(refined);
  CGAL::exude_mesh_3(refined, p::time_limit = 0, p::sliver_bound = aim);
  tets = tets_of(refined);
  return fills_manifold(tets) ? tets : with_slivers;
}

struct FilledSurface {
  Mesh tets;
  bool creased = false;
};

// Fills the surface, keeping edges with a larger angle [rad] than crease_angle; none if that does not end.
std::optional<FilledSurface> fill_surface(const CgalMesh& surface, const Sizes& sizes, const TetrahedralizeOptions& o, double crease_angle,
                                  std::size_t most_vertices) {
  CGAL::get_default_random() = CGAL::Random(0);
  Domain domain(surface);
  domain.detect_features(crease_angle * degrees);
  const Creases creases(domain);
  const Criteria bounds = criteria(sizes, o.radius_edge, creases);
  Complex complex;
  CGAL::Mesh_3::internal::C3t3_initializer<Complex, Domain, Criteria, true>()(complex, domain, bounds, true);
  if (!refine(complex, domain, bounds, most_vertices)) return std::nullopt;
  if (seed_missed_patches(domain, complex) && !refine(complex, domain, bounds, most_vertices)) return std::nullopt;
  const double aim = std::max(12.0, o.dihedral_angle * degrees + 1);
  return FilledSurface{without_slivers(complex, domain, aim), !creases.none()};
}

// Returns a generous bound of the number of vertices: inside, on the surface, and where its curvature needs shorter edges.
std::size_t most_vertices(const Sizes& s, double volume, double area) {
  const double inside = volume / std::pow(s.inside, 3), on = area / (s.surface * s.surface), curved = area / (s.surface * s.deviation);
  return static_cast<std::size_t>(10000 + 10 * (2 * inside + 2 * on + curved));
}

struct Deviation {
  SurfaceDeviation from_input, from_tets;
  double largest() const { return std::max(from_input.largest, from_tets.largest); }
};

Deviation deviation_of(const Mesh& surface, const Mesh& tets, double spacing) {
  const Mesh border = triangle_surface(tets, "tets");
  return {surface_deviation(surface, border, spacing), surface_deviation(border, surface, spacing)};
}

struct Meshing {
  Mesh tets;
  Deviation deviation;
  AngleHistogram angles;

  bool satisfies(double asked, const TetrahedralizeOptions& o) const {
    return !tets.tets.empty() && deviation.largest() <= asked && angles.smallest >= o.dihedral_angle * degrees;
  }
  bool better_than(const Meshing& other, double asked) const {
    const double excess = std::max(1.0, deviation.largest() / asked), others = std::max(1.0, other.deviation.largest() / asked);
    return excess < others || (excess == others && angles.smallest > other.angles.smallest);
  }
};

// Returns why the tets do not fill a closed manifold; "": they do.
std::string flaws_of(const Mesh& tets, const std::string& name) {
  if (tets.tets.empty()) return "no tet came out; ask for shorter edges";
  const SurfaceDefects defects = find_defects(triangle_surface(tets, name), false);
  if (defects.closed() && defects.manifold()) return "";
  std::string text = "the surface of the tets is no closed manifold; ask for shorter edges, or a smaller deviation:";
  for (const std::string& line : list_defects(defects)) text += "\n  " + line;
  return text;
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
  const std::size_t most = most_vertices(sizes, volume, total_area(surface));
  double crease_angle = o.crease_angle;
  Meshing best;
  // CGAL bounds the distance from the centre of each face to the surface, but not that of curved creases. The measured deviation
  // determines the next sizes; the sagitta of a crease grows with the square of its edge length. Remaining slivers are beside
  // creases with edges too long for the curvature, because CGAL does not refine inside the balls that protect them. On a coarse
  // round surface every edge is a crease; where they cannot all be protected, the bluntest ones are given up.
  for (int attempt = 0; attempt < 5 && !best.satisfies(asked, o); ++attempt) {
    std::optional<FilledSurface> inside;
    std::string flaws;
    const auto fill = [&] {
      inside = fill_surface(m, sizes, o, crease_angle, most);
      flaws = inside ? flaws_of(inside->tets, name)
                     : "the refinement does not end; ask for a larger deviation, or remesh the surface with shorter edges first";
      return flaws.empty();
    };
    bool filled = fill();
    for (; !filled && attempt == 0 && crease_angle < no_crease; filled = fill())
      crease_angle = std::min(crease_angle + 15 / degrees, no_crease);
    if (!filled && attempt > 0) break;
    if (!filled) throw InputError(fmt::format("{}: {}", name, flaws));
    Meshing now;
    now.tets = std::move(inside->tets);
    now.deviation = deviation_of(surface, now.tets, asked);
    now.angles = dihedral_angles(now.tets);
    const double excess = now.deviation.largest() / asked;
    if (attempt == 0 || now.better_than(best, asked)) best = std::move(now);
    if (excess > 1) {
      sizes.deviation *= 0.8 / excess;
      sizes.crease *= std::sqrt(0.8 / excess);
    } else if (inside->creased) {
      sizes.crease *= 0.7;
    } else {
      break;
    }
  }
  const Mesh& tets = best.tets;
  const Deviation& deviation = best.deviation;
  const double made = total_volume(tets);
  notes.push_back(fmt::format("{} triangles filled with {} tets; volume {:.8g} m^3, {:+.3g} % of the surface's", surface.triangles.size(),
                              tets.tets.size(), made, 100 * (made / volume - 1)));
  notes.push_back(fmt::format("distance from the old surface to the new: at most {:.3g} m, rms {:.2g} m; back: at most {:.3g} m, rms "
                              "{:.2g} m", deviation.from_input.largest, deviation.from_input.rms, deviation.from_tets.largest,
                              deviation.from_tets.rms));
  if (crease_angle > o.crease_angle)
    notes.push_back(fmt::format("{}{:.3g} degrees are not kept but rounded, within the deviation: they are too "
                                "close to each other; if they are not meant, remesh with shorter edges or raise crease_angle",
                                mesh_warning::rounded_creases, crease_angle * degrees));
  if (deviation.largest() > asked) {
    const SurfaceDeviation& worst =
        deviation.from_input.largest > deviation.from_tets.largest ? deviation.from_input : deviation.from_tets;
    notes.push_back(fmt::format("{}{:.3g} m asked for, at ({:.4g}, {:.4g}, {:.4g}); ask for shorter edges, "
                                "or a smaller crease_angle", mesh_warning::missed_deviation, asked, worst.position[0], worst.position[1], worst.position[2]));
  }
  if (const AngleHistogram& angles = best.angles; angles.smallest < o.dihedral_angle * degrees)
    notes.push_back(fmt::format("{}{:.3g} degrees of tet {} at ({:.4g}, {:.4g}, {:.4g}) is below the {:.3g} asked "
                                "for; ask for shorter edges, or remesh the surface first", mesh_warning::missed_angle, angles.smallest, angles.worst, angles.centroid[0],
                                angles.centroid[1], angles.centroid[2], o.dihedral_angle * degrees));
  return std::move(best.tets);
}

}  // namespace tack
