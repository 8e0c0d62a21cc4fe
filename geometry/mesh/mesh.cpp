#include "geometry/mesh/mesh.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "geometry/errors.hpp"

namespace tack {
namespace {

template <class Element>
void append_shifted(std::vector<Element>& to, const std::vector<Element>& from, int shift) {
  to.reserve(to.size() + from.size());
  for (Element element : from) {
    for (int& index : element) index += shift;
    to.push_back(element);
  }
}

void append_shifted(std::vector<int>& to, const std::vector<int>& from, int shift) {
  to.reserve(to.size() + from.size());
  for (int index : from) to.push_back(index + shift);
}

void flip_orientation(Mesh& mesh) {
  for (Tet& tet : mesh.tets) std::swap(tet[2], tet[3]);
  for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

}  // namespace

void translate(Mesh& mesh, const Vec3& offset) {
  if (!offset.allFinite()) {
    throw InputError(fmt::format("a mesh cannot be translated by ({}, {}, {}): give finite numbers",
                                 offset.x(), offset.y(), offset.z()));
  }
  for (Vec3& x : mesh.vertices) x += offset;
}

void rotate(Mesh& mesh, const Vec3& axis, double angle) {
  const double length = axis.norm();
  if (!(length > 0) || !std::isfinite(length) || !std::isfinite(angle)) {
    throw InputError(fmt::format("a mesh cannot be rotated by {} about the axis ({}, {}, {}): give "
                                 "a finite angle and an axis that is not zero",
                                 angle, axis.x(), axis.y(), axis.z()));
  }
  const Mat3 rotation = Eigen::AngleAxisd(angle, axis / length).toRotationMatrix();
  for (Vec3& x : mesh.vertices) x = (rotation * x).eval();
}

void scale(Mesh& mesh, const Vec3& factors) {
  if (!factors.allFinite() || (factors.array() == 0).any()) {
    throw InputError(fmt::format("a mesh cannot be scaled by ({}, {}, {}): every factor has to be "
                                 "finite and different from zero",
                                 factors.x(), factors.y(), factors.z()));
  }
  for (Vec3& x : mesh.vertices) x = x.cwiseProduct(factors).eval();
  const bool mirrored = ((factors.array() < 0).count() % 2) == 1;
  if (mirrored) flip_orientation(mesh);
}

void append(Mesh& mesh, const Mesh& other) {
  const Mesh added = other;  // `other` may be `mesh` itself
  const int shift = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), added.vertices.begin(), added.vertices.end());
  append_shifted(mesh.tets, added.tets, shift);
  append_shifted(mesh.triangles, added.triangles, shift);
  append_shifted(mesh.edges, added.edges, shift);
  append_shifted(mesh.points, added.points, shift);
  for (const auto& [name, group] : added.tags) append_shifted(mesh.tags[name], group, shift);
}

Eigen::AlignedBox3d bounding_box(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : mesh.vertices) box.extend(x);
  return box;
}

}  // namespace tack
