#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "geometry/errors.hpp"
#include "geometry/msh/functions.hpp"
#include "geometry/msh/gmsh_session.hpp"
#include "geometry/msh/gmsh_types.hpp"
#include "geometry/plain_numbers.hpp"

namespace tack {
namespace {

using NodeNumbers = std::unordered_map<std::size_t, int>;

NodeNumbers read_nodes(Mesh& mesh) {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  std::vector<std::size_t> order(tags.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return tags[a] < tags[b]; });
  NodeNumbers numbers;
  for (std::size_t i : order) {
    if (!numbers.emplace(tags[i], static_cast<int>(mesh.vertices.size())).second) continue;
    mesh.vertices.emplace_back(Eigen::Map<const Vec3>(&coordinates[3 * i]));
  }
  return numbers;
}

int number_of(const NodeNumbers& numbers, std::size_t tag) {
  const auto found = numbers.find(tag);
  if (found == numbers.end()) throw fmt::format("node {} is used but not defined", tag);
  return found->second;
}

template <std::size_t N>
void read_elements(int type, const NodeNumbers& numbers,
                   std::vector<std::array<int, N>>& elements) {
  std::vector<std::size_t> tags, nodes;
  gmsh::model::mesh::getElementsByType(type, tags, nodes);
  for (std::size_t e = 0; e < tags.size(); ++e) {
    std::array<int, N>& element = elements.emplace_back();
    for (std::size_t i = 0; i < N; ++i) element[i] = number_of(numbers, nodes[N * e + i]);
  }
}

void check_types(const std::string& name) {
  constexpr int known[] = {gmsh_types::line, gmsh_types::triangle, gmsh_types::tet, gmsh_types::point};
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types);
  for (int type : types) {
    if (std::find(std::begin(known), std::end(known), type) != std::end(known)) continue;
    std::string kind;
    int dimension = 0, order = 0, nodes = 0, primary = 0;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(type, kind, dimension, order, nodes, local, primary);
    throw InputError(fmt::format("{}: holds elements of the kind \"{}\": supported are points, and "
                                 "lines, triangles and tets of order 1; remesh with those",
                                 name, kind));
  }
}

void read_groups(Mesh& mesh, const NodeNumbers& numbers) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups);
  for (const auto& [dimension, tag] : groups) {
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    std::vector<std::size_t> nodes;
    std::vector<double> coordinates;
    gmsh::model::mesh::getNodesForPhysicalGroup(dimension, tag, nodes, coordinates);
    auto& group = mesh.tags[name.empty() ? std::to_string(tag) : name];
    for (std::size_t node : nodes) group.push_back(number_of(numbers, node));
  }
  for (auto& [name, group] : mesh.tags) {
    std::sort(group.begin(), group.end());
    group.erase(std::unique(group.begin(), group.end()), group.end());
  }
}

Mesh read_model(const std::string& name) {
  gmsh::open(name);
  check_types(name);
  Mesh mesh;
  const NodeNumbers numbers = read_nodes(mesh);
  read_elements(gmsh_types::tet, numbers, mesh.tets);
  read_elements(gmsh_types::triangle, numbers, mesh.triangles);
  read_elements(gmsh_types::line, numbers, mesh.edges);
  std::vector<std::array<int, 1>> points;
  read_elements(gmsh_types::point, numbers, points);
  for (const auto& [v] : points) mesh.points.push_back(v);
  read_groups(mesh, numbers);
  return mesh;
}

// Gmsh reports errors as strings.
template <class Work>
auto translate_errors(const std::string& name, const char* remedy, const Work& work) {
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}: {}", name, what, remedy));
  };
  const PlainNumbers plain;
  const GmshSession session;
  try {
    return work();
  } catch (const InputError&) {
    throw;
  } catch (const std::string& what) {
    fail(what);
  } catch (const std::exception& error) {
    fail(error.what());
  }
  return decltype(work())();
}

}  // namespace

Mesh read_msh_by_gmsh(const std::string& path) {
  return translate_errors(path, "the .msh file is damaged, export it again", [&] { return read_model(path); });
}

}  // namespace tack
