#include "framework/remesh/new_elements.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "framework/remesh/element_transfer.hpp"
#include "framework/remesh/hencky.hpp"
#include "geometry/tet_coordinates.hpp"
#include "geometry/tets/improve_tets.hpp"

namespace tack {
namespace {

std::vector<Vec3> local(const Body& body, const VecX& x) {
  std::vector<Vec3> positions;
  for (int v = 0; v < body.vertex_count; ++v) positions.push_back(vertex(x, body.first_vertex + v));
  return positions;
}

template <class Element>
std::vector<Element> local(const Body& body, std::vector<Element> elements) {
  for (Element& element : elements)
    for (int& v : element) v -= body.first_vertex;
  return elements;
}

std::array<Vec3, 4> corners_of(const Tet& tet, const std::vector<Vec3>& positions) {
  return {positions[tet[0]], positions[tet[1]], positions[tet[2]], positions[tet[3]]};
}

// Returns the point in the tet of `among` that contains it, or else in the nearest one by barycentric coordinates.
TetPoint nearest_tet_point(const Vec3& point, const std::vector<int>& among, const std::vector<Tet>& tets, const std::vector<Vec3>& positions) {
  TetPoint best{};
  double deepest = -std::numeric_limits<double>::infinity();
  for (const int t : among) {
    const auto weights = tet_coordinates(corners_of(tets[t], positions), point);
    const double depth = *std::min_element(weights.begin(), weights.end());
    if (depth > deepest) deepest = depth, best = {tets[t], weights};
  }
  return best;
}

// Data transferred from old tets to new tets.
struct Exchange {
  std::vector<int> removed;          // indices of old tets
  std::vector<TetContent> contents;  // of new tets, in their order
};

Exchange exchange_tets(const ImprovedTets& improved, const std::vector<Tet>& tets, const std::vector<Vec3>& positions, const ExchangeableTets& old, const std::vector<Mat3>& elastic) {
  const std::vector<double> volumes = old.volumes(), flow = old.plastic_strains();
  std::vector<char> stays(tets.size(), 0);
  for (const int t : improved.kept)
    if (t >= 0) stays[t] = 1;
  Exchange result;
  TetCorners from, to;
  std::vector<TetContent> contents;
  for (size_t t = 0; t < tets.size(); ++t) {
    if (stays[t]) continue;
    result.removed.push_back(static_cast<int>(t));
    from.push_back(corners_of(tets[t], positions));
    contents.push_back({volumes[t], hencky_strain(elastic[t]), flow[t]});
  }
  for (size_t t = 0; t < improved.tets.size(); ++t)
    if (improved.kept[t] < 0) to.push_back(corners_of(improved.tets[t], improved.vertices));
  result.contents = transfer_contents(from, contents, to);
  return result;
}

// Returns the rest position of the material at a point of the old mesh.
Vec3 material_position(const TetPoint& point, const std::vector<Vec3>& rest) {
  Vec3 at = Vec3::Zero();
  for (int i = 0; i < 4; ++i) at += point.weights[i] * rest[point.vertices[i]];
  return at;
}

std::vector<Triangle> renumbered(std::vector<Triangle> surface, const std::vector<int>& from, size_t before) {
  std::vector<int> number(before, -1);
  for (size_t v = 0; v < from.size(); ++v)
    if (from[v] >= 0) number[from[v]] = static_cast<int>(v);
  for (Triangle& t : surface)
    for (int& v : t) v = number[v];
  return surface;
}

// Returns the vertex groups. A new vertex belongs to the groups of all corners of the tet that it lies in.
std::map<std::string, std::vector<int>> groups(const Body& body, const NewElements& now) {
  std::map<std::string, std::vector<int>> tags;
  for (const auto& [name, members] : body.tags) {
    const std::set<int> all(members.begin(), members.end());
    std::vector<int>& group = tags[name];
    for (size_t v = 0; v < now.from.size(); ++v) {
      const Tet& t = now.within[v].vertices;
      const bool belongs = now.from[v] >= 0 ? all.contains(now.from[v]) : std::all_of(t.begin(), t.end(), [&](int w) { return all.contains(w); });
      if (belongs) group.push_back(static_cast<int>(v));
    }
  }
  return tags;
}

}  // namespace

NewElements new_elements(int index, const Body& body, const ExchangeableTets& old, const VecX& rest, const VecX& x, double goal) {
  const std::vector<Vec3> positions = local(body, x), rest_positions = local(body, rest);
  const std::vector<Tet> tets = local(body, *old.tets);
  const std::vector<Mat3> elastic = old.elastic(x);
  const std::vector<double> volumes = old.volumes(), flow = old.plastic_strains();
  const ImprovedTets improved = improve_tets(positions, tets, goal);
  const Exchange exchange = exchange_tets(improved, tets, positions, old, elastic);

  NewElements now{index, {}, improved.vertices, improved.from, {}, {}, improved.before, improved.after};
  for (size_t t = 0, next = 0; t < improved.tets.size(); ++t) {
    const int k = improved.kept[t];
    const Mat3 inverse = edges_of(corners_of(improved.tets[t], improved.vertices)).inverse();
    if (k < 0) {
      const TetContent& contents = exchange.contents[next++];
      now.mesh.references.push_back({inverse * stretch_of(contents.strain), contents.volume});
      now.flow.push_back(contents.flow);
    } else {
      now.mesh.references.push_back({inverse * elastic[k], volumes[k]});
      now.flow.push_back(flow[k]);
    }
  }
  for (size_t v = 0; v < improved.vertices.size(); ++v) {
    const int w = improved.from[v];
    now.within.push_back(w >= 0 ? TetPoint{} : nearest_tet_point(improved.vertices[v], exchange.removed, tets, positions));
    now.mesh.mesh.vertices.push_back(w >= 0 ? rest_positions[w] : material_position(now.within.back(), rest_positions));
  }
  now.mesh.surface = renumbered(local(body, body.triangles), improved.from, positions.size());
  now.mesh.mesh.tets = improved.tets;
  now.mesh.mesh.tags = groups(body, now);
  return now;
}

}  // namespace tack
