#include "framework/scene/contact_support.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/errors.hpp"
#include "geometry/mesh/surface.hpp"

namespace tack {
namespace {

template <class Element>
Element sorted_element(Element e) {
  std::sort(e.begin(), e.end());
  return e;
}

std::vector<Triangle> tet_faces(const Mesh& mesh) {
  std::vector<Triangle> faces;
  for (const auto& [a, b, c, d] : mesh.tets)
    for (const Triangle& f : {Triangle{a, b, c}, Triangle{a, b, d}, Triangle{a, c, d}, Triangle{b, c, d}})
      faces.push_back(sorted_element(f));
  std::sort(faces.begin(), faces.end());
  return faces;
}

std::vector<int> triangles_beside_tets(const Mesh& mesh) {
  if (mesh.tets.empty()) return {};
  const std::vector<Triangle> faces = tet_faces(mesh);
  std::vector<int> found;
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!std::binary_search(faces.begin(), faces.end(), sorted_element(mesh.triangles[t])))
      found.push_back(static_cast<int>(t));
  return found;
}

std::vector<int> rods(const Mesh& mesh, const Surface& surface) {
  std::vector<Edge> alone;
  for (const int e : surface.codim_edges) alone.push_back(surface.edges[e]);
  std::vector<int> found;
  for (size_t e = 0; e < mesh.edges.size(); ++e)
    if (std::binary_search(alone.begin(), alone.end(), sorted_element(mesh.edges[e])))
      found.push_back(static_cast<int>(e));
  return found;
}

std::vector<int> particles(const Mesh& mesh, const Surface& surface) {
  std::vector<int> found;
  for (size_t p = 0; p < mesh.points.size(); ++p)
    if (std::binary_search(surface.codim_points.begin(), surface.codim_points.end(), mesh.points[p]))
      found.push_back(static_cast<int>(p));
  return found;
}

// "triangles 4, 5, 6 and 9 more"
std::string listed(const char* kind, const std::vector<int>& numbers) {
  constexpr size_t most = 5;
  const std::vector<int> first(numbers.begin(), numbers.begin() + std::min(most, numbers.size()));
  std::string text = fmt::format("{}{} {}", kind, numbers.size() > 1 ? "s" : "", fmt::join(first, ", "));
  if (numbers.size() > most) text += fmt::format(" and {} more", numbers.size() - most);
  return text;
}

void refuse(const std::string& object, const char* kind, const std::vector<int>& numbers, const char* why) {
  if (numbers.empty()) return;
  throw InputError(fmt::format("object '{}': {} (counted from 0) {}, or remove the contact section", object,
                               listed(kind, numbers), why));
}

}  // namespace

void refuse_unsupported_contact(const Mesh& mesh, const std::string& object) {
  refuse(object, "triangle", triangles_beside_tets(mesh),
         "would be in no contact, as they are not faces of its tets: make the triangles an object of their own");
  const Surface surface = extract_surface(mesh);
  refuse(object, "edge", rods(mesh, surface),
         "would be in no contact, as rods have no area yet: give the object a surface of triangles or tets");
  refuse(object, "point", particles(mesh, surface),
         "would be in no contact, as particles have no area yet: give the object a surface of triangles or tets");
}

}  // namespace tack
