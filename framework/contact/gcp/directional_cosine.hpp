// Cosines between the direction from one primitive of a pair to the other and a direction of the
// surface there, as functions of few differences of positions:
//     vertex-vertex  U = r                      r = x0 - x1
//     vertex-edge    U = |a|^2 q - (q . a) a    q = x0 - x1, a = x2 - x1
//     vertex-face    U = b x c                  b = x2 - x1, c = x3 - x1
//     edge-edge      U = a x b                  a = x1 - x0, b = x3 - x2
// U is parallel to the shortest vector, from the second primitive to the first for a sign s (1 for
// the first two kinds). Directions of the surface: at a vertex, the edge t to a neighbour and the
// normal t1 x t2 of a triangle; at an edge e, the part of o (to the opposite vertex) orthogonal to
// e, and the normal e x o.
#pragma once

#include <cmath>

#include "framework/assembly/dual_many.hpp"
#include "framework/contact/gcp/gcp_stencil.hpp"

namespace tack {

// A difference of two positions: local indices.
struct Difference {
  int plus, minus;
};

template <class T>
using Vector3 = std::array<T, 3>;

template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
// Returns |a|^2 times the part of q orthogonal to a.
template <class T>
Vector3<T> orthogonal_part(const Vector3<T>& q, const Vector3<T>& a) {
  const T aa = dot(a, a), qa = dot(q, a);
  return {aa * q[0] - qa * a[0], aa * q[1] - qa * a[1], aa * q[2] - qa * a[2]};
}
template <class T>
T cosine_of(const Vector3<T>& u, const Vector3<T>& v) {
  using std::sqrt;
  return dot(u, v) / sqrt(dot(u, u) * dot(v, v));
}

// The differences behind U, and the edge of a primitive among them (-1: a vertex).
struct PairDifferences {
  std::array<Difference, 2> differences;
  int count;
  std::array<int, 2> edge_of;  // per primitive: index of the difference along the edge
};

constexpr PairDifferences pair_differences(GcpKind kind) {
  switch (kind) {
    case GcpKind::vertex_vertex: return {{{{0, 1}, {0, 0}}}, 1, {-1, -1}};
    case GcpKind::vertex_edge: return {{{{0, 1}, {2, 1}}}, 2, {-1, 1}};
    case GcpKind::vertex_face: return {{{{2, 1}, {3, 1}}}, 2, {-1, -1}};
    case GcpKind::edge_edge: break;
  }
  return {{{{1, 0}, {3, 2}}}, 2, {0, 1}};
}

template <GcpKind Kind, class T>
Vector3<T> shortest_direction(const Vector3<T>* v) {
  if constexpr (Kind == GcpKind::vertex_vertex) return v[0];
  else if constexpr (Kind == GcpKind::vertex_edge) return orthogonal_part(v[0], v[1]);
  else return cross(v[0], v[1]);
}

// A cosine with its differences. Kind, Type: of the pair and the factor; Primitive: of the factor.
template <GcpKind Kind, GcpFactor::Type Type, int Primitive>
struct DirectionalCosine {
  static constexpr PairDifferences pair = pair_differences(Kind);
  static constexpr int edge = pair.edge_of[Primitive];
  static constexpr bool at_edge = edge >= 0;
  static constexpr int count = pair.count + (!at_edge && Type == GcpFactor::Type::exterior ? 2 : 1);
  static constexpr int variables = 3 * count;

  static std::array<Difference, count> differences(const GcpFactor& f) {
    std::array<Difference, count> d;
    for (int i = 0; i < pair.count; ++i) d[i] = pair.differences[i];
    const int base = at_edge ? pair.differences[at_edge ? edge : 0].minus : Primitive;
    d[pair.count] = {f.a, base};
    if constexpr (count == pair.count + 2) d[pair.count + 1] = {f.b, base};
    return d;
  }
  // v: the differences. Returns the cosine of U and the direction of the surface.
  template <class T>
  static T cosine(const GcpFactor& f, const Vector3<T>* v) {
    const Vector3<T> u = shortest_direction<Kind>(v);
    const Vector3<T>& own = v[pair.count];
    if constexpr (at_edge) {
      if constexpr (Type == GcpFactor::Type::tangent)
        return cosine_of(u, orthogonal_part(own, v[edge]));
      else return cosine_of(u, cross(v[edge], own)) * (f.b ? 1.0 : -1.0);
    } else if constexpr (Type == GcpFactor::Type::tangent) {
      return cosine_of(u, own);
    } else {
      return cosine_of(u, cross(own, v[pair.count + 1]));
    }
  }
};

// Calls body(DirectionalCosine) for the kind and the factor. A face has no factors.
template <class Body>
auto with_cosine(GcpKind kind, const GcpFactor& f, const Body& body) {
  const auto of_kind = [&]<GcpKind Kind>() {
    using enum GcpFactor::Type;
    if (f.primitive == 0)
      return f.type == tangent ? body(DirectionalCosine<Kind, tangent, 0>{})
                               : body(DirectionalCosine<Kind, exterior, 0>{});
    if constexpr (Kind == GcpKind::vertex_face) return body(DirectionalCosine<Kind, tangent, 0>{});
    else
      return f.type == tangent ? body(DirectionalCosine<Kind, tangent, 1>{})
                               : body(DirectionalCosine<Kind, exterior, 1>{});
  };
  switch (kind) {
    case GcpKind::vertex_vertex: return of_kind.template operator()<GcpKind::vertex_vertex>();
    case GcpKind::vertex_edge: return of_kind.template operator()<GcpKind::vertex_edge>();
    case GcpKind::vertex_face: return of_kind.template operator()<GcpKind::vertex_face>();
    case GcpKind::edge_edge: break;
  }
  return of_kind.template operator()<GcpKind::edge_edge>();
}

}  // namespace tack
