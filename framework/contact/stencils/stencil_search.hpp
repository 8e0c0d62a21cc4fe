// Search for active stencils: what contact models share of it (area_integral/narrow_phase.hpp,
// ipc/pair_sums.hpp). Stencils of vertices come from features (point_features.hpp), those of edges
// from pairs that are chosen once per list of candidates. Chunks are searched in parallel and
// joined in their order.
#pragma once

#include <array>
#include <span>
#include <type_traits>
#include <vector>

#include "framework/contact/stencils/contact_set.hpp"
#include "framework/contact/stencils/point_features.hpp"
#include "geometry/broad_phase/changed_primitives.hpp"
#include "geometry/broad_phase/displacement_bounds.hpp"

namespace tack {

// Flags per global vertex; empty: all vertices are free. A stencil of a fixed point and a fixed
// feature is constant, but the nearest feature may change to one with a free vertex of the same
// triangle. Such stencils are left out only where no vertex of the feature is in the one-ring.
struct FreeVertices {
  FreeVertices() = default;
  FreeVertices(const CollisionMesh& mesh, std::vector<char> free_vertices);

  std::vector<char> free;
  std::vector<char> one_ring;  // free, or on an edge with a free vertex
};

// Returns whether any vertex is marked; an empty list marks all.
inline bool any_of(const std::vector<char>& marked, std::span<const int> vertices) {
  return marked.empty() ||
         std::any_of(vertices.begin(), vertices.end(), [&](int v) { return marked[v] != 0; });
}

using FoundStencils = ContactSet;  // of one chunk, without thresholds

// Adds the stencil of a vertex p and a feature. point: its contact point, below found.point_count.
inline void add_stencil(int p, const PointFeature& f, int law, int point, double weight,
                        FoundStencils& found) {
  const auto& v = f.vertices;
  switch (f.count()) {
    case 1: found.point_point.push_back({{p, v[0]}, law, point, weight}); break;
    case 2: found.point_edge.push_back({{p, v[0], v[1]}, law, point, weight}); break;
    default: found.point_triangle.push_back({{p, v[0], v[1], v[2]}, law, point, weight});
  }
}

// Base of the searches for stencils of vertices and of interior points, with the buffers of one
// thread.
class PointSearch {
 protected:
  PointSearch(const CollisionMesh& mesh, const FreeVertices& free, const VecX& x,
              FoundStencils& found)
      : mesh_(mesh), x_(x), found_(found), free_(free) {}

  // Adds a stencil that may move. Own: the number of vertices of the point, before those of the
  // feature.
  template <int Own, class Stencil>
  void add_if_free(std::vector<Stencil>& stencils, const std::type_identity_t<Stencil>& stencil) {
    const std::span<const int> all(stencil.vertices);
    if (any_of(free_.free, all.first(Own)) || any_of(free_.one_ring, all.subspan(Own)))
      stencils.push_back(stencil);
  }
  // Adds the stencil of a vertex p and a feature. point: the contact point.
  void add(int p, const PointFeature& f, int law, int point, double weight) {
    const auto& v = f.vertices;
    switch (f.count()) {
      case 1: add_if_free<1>(found_.point_point, {{p, v[0]}, law, point, weight}); break;
      case 2: add_if_free<1>(found_.point_edge, {{p, v[0], v[1]}, law, point, weight}); break;
      default: add_if_free<1>(found_.point_triangle, {{p, v[0], v[1], v[2]}, law, point, weight});
    }
  }

  const CollisionMesh& mesh_;
  const VecX& x_;
  FoundStencils& found_;
  std::vector<Triangle> triangles_;

 private:
  const FreeVertices& free_;
};

// Pairs of edges that press.
class EdgePairs {
 public:
  // Edges of one object that are neighbours at rest (rest_gaps.hpp) press or do not.
  enum class RestNeighbours { press, do_not_press };
  // Both must outlive this.
  EdgePairs(const ContactSurface& surface, const PairTable& pairs, RestNeighbours neighbours)
      : surface_(surface), pairs_(pairs), neighbours_(neighbours) {}

  // Chooses the pairs among new candidates, and their laws. changed: pairs without changed edges
  // keep their law; null: none does.
  void choose(const Candidates& candidates, const ChangedPrimitives* changed);
  int size() const { return static_cast<int>(chosen_.size()); }
  // Appends the stencils of the pairs first .. last - 1 that are closer than the range of their
  // law. edge_area: per edge of the mesh [m^2]; the weight of a pair is the area factor of its role
  // times the sum of both, with the larger one cut to the role's ratio. An edge without area does
  // not limit the area of the other.
  void search(const Candidates& candidates, const DisplacementBounds& displacements,
              const std::vector<char>& free, const VecX& x, int first, int last,
              const std::vector<double>& edge_area, FoundStencils& found) const;
  // The same for one pair, which is always looked at.
  void search(const std::vector<char>& free, const VecX& x, int pair,
              const std::vector<double>& edge_area, FoundStencils& found) const;
  const std::array<int, 2>& edges(int pair) const { return chosen_[pair].edges; }

 private:
  // A candidate between two edges of the mesh.
  struct EdgePair {
    int candidate = 0;
    std::array<int, 2> edges{};
    int law = -1;  // of the pair table

    const std::array<int, 2>& key() const { return edges; }
  };
  const PairRole& role_of(const Edge& a, const Edge& b) const;

  const ContactSurface& surface_;
  const PairTable& pairs_;
  RestNeighbours neighbours_;
  std::vector<EdgePair> chosen_;         // in the order of candidates
  std::vector<EdgePair> chosen_before_;  // memory for the next list
};

// Replaces the stencils of a set by those of all chunks, sorted by law, and sets the thresholds of
// the edge-edge mollifier. Contact points are numbered on from chunk to chunk; chunks without a
// point_count have numbers that hold for all. rest: rest positions [m].
struct FoundChunks {
  std::vector<FoundStencils> points, edges, interior;
};
void join(FoundChunks chunks, const VecX& rest, ContactSet& contacts);
// The same for chunks that may have stencils of all kinds.
void join(std::vector<FoundStencils> chunks, const VecX& rest, ContactSet& contacts);

}  // namespace tack
