#include "solvers/lcp/stored_contacts.hpp"

#include <algorithm>
#include <tuple>

#include "geometry/errors.hpp"
#include "geometry/mesh/object_elements.hpp"

namespace tack {
namespace {

const std::string points_name = "lcp/points", edges_name = "lcp/edges";

// Columns: triangle, side, gap, depth, force; edges a and b, normal, gap, depth, force. Triangles
// and edges are numbered in their object, so that other objects of a scene have no effect.
constexpr int point_width = 7, edge_width = 10;

void require(bool fits) {
  if (!fits) throw InputError("the stored contacts do not fit the objects, because another scene stored them; start the run again");
}

int number(const std::vector<int>& first, int object, double in_object) {
  require(object >= 0 && object + 1 < static_cast<int>(first.size()) && in_object >= 0 && in_object < first[object + 1] - first[object]);
  return first[object] + static_cast<int>(in_object);
}

}  // namespace

void StoredContacts::sort() {
  const auto of_point = [](const StoredPoint& h) { return std::tuple(h.point, h.object, h.triangle); };
  const auto of_edges = [](const StoredEdges& h) { return std::pair(h.a, h.b); };
  std::stable_sort(points.begin(), points.end(), [&](const StoredPoint& m, const StoredPoint& n) { return of_point(m) < of_point(n); });
  std::stable_sort(edges.begin(), edges.end(), [&](const StoredEdges& m, const StoredEdges& n) { return of_edges(m) < of_edges(n); });
}

StoredContacts StoredContacts::read(const History& history, const ContactSurface& surface) {
  StoredContacts stored;
  const CollisionMesh& mesh = surface.mesh;
  const auto triangles = first_of_objects(mesh, mesh.triangles);
  const auto edges = first_of_objects(mesh, mesh.edges);
  const auto object_of = [&](int v) {
    require(v >= 0 && v < static_cast<int>(mesh.vertex_object.size()));
    return mesh.vertex_object[v];
  };
  if (const auto found = history.find(points_name); found != history.end()) {
    const HistoryArray& array = found->second;
    require(array.width == point_width && array.keys.size() == static_cast<size_t>(array.entries()));
    stored.begun = true;
    for (int i = 0; i < array.entries(); ++i) {
      const double* v = &array.values[static_cast<size_t>(i) * point_width];
      const auto [point, object] = array.keys[i];
      object_of(point);
      stored.points.push_back({point, object, number(triangles, object, v[0]), v[1], v[2], v[3], Vec3(v[4], v[5], v[6])});
    }
  }
  if (const auto found = history.find(edges_name); found != history.end()) {
    const HistoryArray& array = found->second;
    require(array.width == edge_width && array.keys.size() == static_cast<size_t>(array.entries()));
    for (int i = 0; i < array.entries(); ++i) {
      const double* v = &array.values[static_cast<size_t>(i) * edge_width];
      const auto [vertex_of_a, object] = array.keys[i];
      stored.edges.push_back({number(edges, object_of(vertex_of_a), v[0]), number(edges, object, v[1]), Vec3(v[2], v[3], v[4]), v[5], v[6], Vec3(v[7], v[8], v[9])});
    }
  }
  return stored;
}

void StoredContacts::erase(History& history) {
  for (const std::string& name : {points_name, edges_name}) history.erase(name);
}

void StoredContacts::write(History& history, const ContactSurface& surface) const {
  const CollisionMesh& mesh = surface.mesh;
  const auto first_triangle = first_of_objects(mesh, mesh.triangles), first_edge = first_of_objects(mesh, mesh.edges);
  HistoryArray &of_points = history[points_name] = {point_width, {}, {}}, &of_edges = history[edges_name] = {edge_width, {}, {}};
  for (const StoredPoint& p : points) {
    of_points.keys.push_back({p.point, p.object});
    of_points.values.insert(of_points.values.end(), {double(p.triangle - first_triangle[p.object]), p.side, p.gap, p.depth, p.force.x(), p.force.y(), p.force.z()});
  }
  for (const StoredEdges& e : edges) {
    const int vertex_of_a = mesh.edges[e.a][0], a = mesh.vertex_object[vertex_of_a], b = mesh.vertex_object[mesh.edges[e.b][0]];
    of_edges.keys.push_back({vertex_of_a, b});
    of_edges.values.insert(of_edges.values.end(), {double(e.a - first_edge[a]), double(e.b - first_edge[b]), e.normal.x(), e.normal.y(), e.normal.z(), e.gap, e.depth,
                                                   e.force.x(), e.force.y(), e.force.z()});
  }
}

}  // namespace tack
