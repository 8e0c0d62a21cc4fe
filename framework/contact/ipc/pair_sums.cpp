#include "framework/contact/ipc/pair_sums.hpp"

#include "framework/config/field.hpp"
#include "framework/contact/contact_model.hpp"
#include "framework/contact/contact_system.hpp"
#include "geometry/broad_phase/broad_phase.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

class IpcModel : public ContactModel {
 public:
  void fields(Fields& f) override {
    f.choice("weights", weights_,
             {{"present_area", PairWeights::present_area, "tributary areas at the start of each step"},
              {"rest_area", PairWeights::rest_area, "a quarter of the tributary areas at rest, as in the convergent formulation"},
              {"equal", PairWeights::equal, "one weight for all pairs of two objects, as in plain IPC: their mean tributary area"}},
             "weights of pairs of primitives");
    f.flag("inclusion_exclusion", inclusion_exclusion_,
           "improved max: triangles less shared edges plus shared vertices, so that a surface counts once at a vertex; every pair of edges counts");
  }
  std::unique_ptr<ContactPotential> make_potential() const override { return std::make_unique<PairSums>(weights_, inclusion_exclusion_); }

 private:
  PairWeights weights_ = PairWeights::present_area;
  bool inclusion_exclusion_ = false;
};
TACK_REGISTER(ContactModel, IpcModel, "ipc", "Sum of the laws over all close pairs of primitives; strengths depend on the mesh.",
              "Li et al. 2020, Incremental Potential Contact; Li et al. 2023, Convergent Incremental Potential Contact");

// Returns the tributary area of a vertex of triangles, rods or particles [m^2].
double tributary_area(const LaggedSurface& surface, int v) {
  return surface.tributary_area(v) + (surface.topology().is_codimensional(v) ? surface.codimensional_area(v) : 0);
}

}  // namespace

// Searches the stencils of vertices.
class PairSums::VertexSearch : PointSearch {
 public:
  VertexSearch(const PairSums& sums, const DisplacementBounds& displacements, const VecX& x, FoundStencils& found)
      : PointSearch(sums.system().surface().mesh, sums.free_, x, found), sums_(sums), candidates_(sums.system().candidates()), displacements_(displacements) {}

  // The vertices of a group have one law: the group is their contact point.
  void search(int index) {
    const PointGroup& group = candidates_.groups.all[index];
    const PairRole& role = sums_.system().pairs().point(mesh_.vertex_object[group.point], group.object);
    if (role.law < 0) return;
    const double weight = role.area_factor * sums_.vertex_weight(group.point, group.object);
    if (weight == 0) return;
    triangles_.clear();
    edges_.clear();
    particles_.clear();
    for (int i = group.triangle_begin; i < group.triangle_end; ++i) {
      const int t = candidates_.point_triangle[i][1];
      const double displacement = displacements_.vertex(group.point) + displacements_.triangle(t);
      if (candidates_.distance_bounds.point_triangle[i] < role.range && candidates_.reference_distances.point_triangle[i] - displacement < role.range)
        triangles_.push_back(mesh_.triangles[t]);
    }
    for (int i = group.edge_begin; i < group.edge_end; ++i) edges_.push_back(mesh_.edges[candidates_.point_edge[i][1]]);
    for (int i = group.other_begin; i < group.other_end; ++i) particles_.push_back(candidates_.groups.particles[i][1]);
    if (triangles_.empty() && edges_.empty() && particles_.empty()) return;
    const FeatureCount count = sums_.inclusion_exclusion_ ? FeatureCount::inclusion_exclusion : FeatureCount::each;
    for (const PointFeature& f : features_.reduce(x_, vertex(x_, group.point), triangles_, edges_, particles_, role.range, count))
      add(group.point, f, role.law, index, weight * f.multiplicity);
  }

 private:
  const PairSums& sums_;
  const Candidates& candidates_;
  const DisplacementBounds& displacements_;
  PointFeatures features_;
  std::vector<Edge> edges_;
  std::vector<int> particles_;
};

// Edges have a law of their own, for which probes do not count area.
PairLawIds PairSums::add_laws(const PairSetup&, const PreparedLaws& laws, PairTable& table) {
  PairLawIds ids;
  ids.pressure = ids.codimensional = table.add_law(laws.barrier_and_adhesion(), laws.tangential);
  ids.safety_barrier = table.add_law(laws.barrier_and_adhesion(), laws.tangential);
  return ids;
}

std::unique_ptr<ContactPotential> PairSums::isolated(int, int) const { return std::make_unique<PairSums>(weights_, inclusion_exclusion_); }

void PairSums::clear_caches() {
  begun_ = false;
  free_ = {};
  const ContactSurface& surface = system().surface();
  edges_.emplace(surface, system().pairs(), EdgePairs::RestNeighbours::press);
  edge_area_ = surface.edge_area;
  if (weights_ == PairWeights::present_area) return;
  LaggedSurface at_rest(surface);
  at_rest.update(surface.rest);
  const std::vector<int>& object = surface.mesh.vertex_object;
  rest_area_.assign(object.size(), 0);
  std::vector<int> count(system().pairs().objects(), 0);
  mean_area_.assign(count.size(), 0);
  for (const int v : surface.mesh.vertices) {
    rest_area_[v] = tributary_area(at_rest, v);
    mean_area_[object[v]] += rest_area_[v];
    ++count[object[v]];
  }
  for (size_t i = 0; i < count.size(); ++i) mean_area_[i] /= std::max(count[i], 1);
  if (weights_ == PairWeights::equal)
    for (size_t e = 0; e < edge_area_.size(); ++e) edge_area_[e] = 2 * mean_area_[object[surface.mesh.edges[e][0]]];
}

void PairSums::set_free(std::vector<char> free) { free_ = {system().surface().mesh, std::move(free)}; }

void PairSums::begin_step(const VecX&, bool new_candidates) {
  if (new_candidates || !begun_) choose_edges(nullptr);
}

void PairSums::set_candidates(const VecX&) { choose_edges(begun_ ? system().broad_phase().changed() : nullptr); }

void PairSums::choose_edges(const ChangedPrimitives* changed) {
  edges_->choose(system().candidates(), changed);
  begun_ = true;
}

// Returns the weight of a vertex [m^2] towards an object.
double PairSums::vertex_weight(int v, int opposite) const {
  if (weights_ == PairWeights::present_area) return tributary_area(system().lagged_surface(), v);
  if (weights_ == PairWeights::rest_area) return rest_area_[v] / 4;
  return (mean_area_[system().surface().mesh.vertex_object[v]] + mean_area_[opposite]) / 2;
}

void PairSums::find(const VecX& x, ContactSet& contacts) {
  const ContactSurface& surface = system().surface();
  const Candidates& candidates = system().candidates();
  const int points = static_cast<int>(candidates.groups.all.size());
  const DisplacementBounds displacements(surface.mesh, [&](int v) { return (vertex(x, v) - vertex(candidates.reference, v)).norm(); });
  FoundChunks found;
  found.points.resize(chunk_count(points));
  found.edges.resize(chunk_count(edges_->size()));
  for_each_chunk(points, [&](int c, int first, int last) {
    VertexSearch search(*this, displacements, x, found.points[c]);
    for (int i = first; i < last; ++i) search.search(i);
  });
  for_each_chunk(edges_->size(), [&](int c, int first, int last) {
    edges_->search(candidates, displacements, free_.free, x, first, last, edge_area_, found.edges[c]);
  });
  join(std::move(found), surface.rest, contacts);
  contacts.point_count = points;
}

}  // namespace tack
