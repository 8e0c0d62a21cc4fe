#include <gmsh.h>

#include <array>
#include <numeric>

#include "geometry/msh/functions.hpp"
#include "geometry/msh/gmsh_session.hpp"
#include "geometry/msh/gmsh_types.hpp"

namespace tack {
namespace {

template <std::size_t N>
void add_elements(int type, const std::vector<std::array<int, N>>& elements, std::size_t& next) {
  std::vector<std::size_t> tags, nodes;
  for (const auto& element : elements) {
    tags.push_back(next++);
    for (const int v : element) nodes.push_back(static_cast<std::size_t>(v) + 1);
  }
  if (!tags.empty()) gmsh::model::mesh::addElementsByType(1, type, tags, nodes);
}

}  // namespace

void write_msh_by_gmsh(const std::string& path, const Mesh& mesh) {
  const GmshSession session;
  gmsh::model::add("mesh");
  for (int dimension = 0; dimension <= 3; ++dimension) gmsh::model::addDiscreteEntity(dimension, 1);
  std::vector<std::size_t> tags(mesh.vertices.size());
  std::iota(tags.begin(), tags.end(), 1);
  std::vector<double> coordinates;
  for (const Vec3& x : mesh.vertices) coordinates.insert(coordinates.end(), x.begin(), x.end());
  gmsh::model::mesh::addNodes(3, 1, tags, coordinates);
  std::vector<std::array<int, 1>> points;
  for (const int v : mesh.points) points.push_back({v});
  std::size_t next = 1;
  add_elements(gmsh_types::tet, mesh.tets, next);
  add_elements(gmsh_types::triangle, mesh.triangles, next);
  add_elements(gmsh_types::line, mesh.edges, next);
  add_elements(gmsh_types::point, points, next);
  gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
  gmsh::option::setNumber("Mesh.Binary", 1);
  gmsh::option::setNumber("Mesh.SaveAll", 1);
  gmsh::write(path);
}

}  // namespace tack
