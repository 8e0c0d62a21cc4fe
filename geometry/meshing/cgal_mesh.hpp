// Conversion between Mesh and CGAL's surface mesh, for source files of this folder only.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <string>

#include "geometry/errors.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalPoint = CgalKernel::Point_3;
using CgalMesh = CGAL::Surface_mesh<CgalPoint>;

inline CgalPoint cgal_point(const Vec3& v) { return {v[0], v[1], v[2]}; }
inline Vec3 vec3(const CgalPoint& p) { return {p.x(), p.y(), p.z()}; }

// Converts an oriented manifold (require_oriented_manifold); elements keep their order.
inline CgalMesh to_cgal(const Mesh& surface) {
  CgalMesh result;
  result.reserve(surface.vertices.size(), 3 * surface.triangles.size(), surface.triangles.size());
  for (const Vec3& v : surface.vertices) result.add_vertex(cgal_point(v));
  using Vertex = CgalMesh::Vertex_index;
  for (const auto& [a, b, c] : surface.triangles)
    if (result.add_face(Vertex(a), Vertex(b), Vertex(c)) == CgalMesh::null_face())
      throw InputError("the surface is no oriented manifold; repair it (`tack mesh repair`)");
  return result;
}

// Converts to Mesh; elements keep their order, removed ones are left out.
inline Mesh from_cgal(const CgalMesh& mesh) {
  Mesh result;
  std::vector<int> number(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), -1);
  for (const auto v : mesh.vertices()) {
    number[v] = static_cast<int>(result.vertices.size());
    result.vertices.push_back(vec3(mesh.point(v)));
  }
  for (const auto f : mesh.faces()) {
    Triangle t{};
    int i = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) t[i++] = number[v];
    result.triangles.push_back(t);
  }
  return result;
}

}  // namespace tack
