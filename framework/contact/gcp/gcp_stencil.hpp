// Stencils of the Geometric Contact Potential: a pair of primitives whose closest points lie inside
// both, with those vertices of their one-rings on which the directional factors depend.
//
//     E = w phi_k(delta - o) M prod_j H(y_j; alpha_t, beta_t) prod_P H(sum_f H(z_f; alpha_n,
//     beta_n) - 1; 1, 0)
//
// delta: distance of the closest points; o: offset; phi_k(g) = phi(k g) / k: the law, shortened by
// k; M: mollifier of closest points at a boundary; y_j = -u . t_j: local-minimum factors of a
// primitive, one per neighbour, with the unit direction u
//     to the other primitive and the unit tangent t_j towards the neighbour;
// z_f = u . n_f: exterior factors, one per triangle at the primitive.
// Factors that are 1 in a neighbourhood are left out, and so are their vertices: the arity differs
// from stencil to stencil. A local index below the number of core vertices is a vertex of the pair.
// Source: Huang et al. 2025, Geometric Contact Potential, ACM TOG 44(4): directional factors,
// discrete potential with closest points as quadrature points.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct GcpSmoothing {
  double alpha_t = 0.5, beta_t = 0;  // of the local-minimum factors; 0 <= -beta < alpha <= 1
  double alpha_n = 0.1, beta_n = 0;  // of the exterior factors
  // Squared distance from the boundary over the squared distance of the primitives below which M
  // < 1.
  double mollifier_width = 0.01;
};

enum class GcpKind : unsigned char { vertex_vertex, vertex_edge, vertex_face, edge_edge };

// Number of vertices of both primitives, and of the first one.
constexpr int gcp_core_count(GcpKind kind) {
  return kind == GcpKind::vertex_vertex ? 2 : kind == GcpKind::vertex_edge ? 3 : 4;
}
constexpr int gcp_first_count(GcpKind kind) { return kind == GcpKind::edge_edge ? 2 : 1; }

// Largest number of vertices of a stencil: two vertices and their one-rings.
inline constexpr int gcp_valence_max = 19, gcp_arity_max = 2 + 2 * gcp_valence_max;

struct GcpFactor {
  enum class Type : unsigned char { tangent, exterior };
  Type type;
  unsigned char primitive;  // 0: the first; 1: the second
  // Local indices. tangent: a is the neighbour, of an edge the opposite vertex. exterior: of a
  // vertex, a and b are the other corners in the triangle's orientation; of an edge, a is the
  // opposite vertex and b is 1 if the triangle has the direction of the edge, else 0.
  unsigned char a, b;
};

struct GcpStencil {
  GcpKind kind;
  unsigned char arity;
  int law;                        // of the pair table
  double weight;                  // w [m^2]
  double offset;                  // o [m]
  double shortening;              // k
  std::array<int, 2> primitives;  // global vertex, edge or triangle of the mesh
  int vertex_begin;               // into GcpStencils::vertices
  int factor_begin,
      factor_end;  // into GcpStencils::factors; exterior factors of a primitive are adjacent
};

// Stencils of one configuration, by ascending arity.
struct GcpStencils {
  std::vector<GcpStencil> stencils;
  std::vector<int> vertices;  // global; of each stencil the core, then others
  std::vector<GcpFactor> factors;

  std::span<const int> vertices_of(const GcpStencil& s) const {
    return {vertices.data() + s.vertex_begin, s.arity};
  }
  std::span<const GcpFactor> factors_of(const GcpStencil& s) const {
    return {factors.data() + s.factor_begin, factors.data() + s.factor_end};
  }
};

}  // namespace tack
