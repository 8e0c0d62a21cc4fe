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
  std::vector<Vec3> places;
  for (int v = 0; v < body.vertex_count; ++v) places.push_back(vertex(x, body.first_vertex + v));
  return places;
}

template <class Element>
std::vector<Element> local(const Body& body, std::vector<Element> elements) {
  for (Element& element : elements)
    for (int& v : element) v -= body.first_vertex;
  return elements;
}

std::array<Vec3, 4> corners_of(const Tet& tet, const std::vector<Vec3>& places) {
  return {places[tet[0]], places[tet[1]], places[tet[2]], places[tet[3]]};
}

// The tet of `among` that a point is in, or least outside of.
Within within(const Vec3& point, const std::vector<int>& among, const std::vector<Tet>& tets, const std::vector<Vec3>& places) {
  Within best{};
  double deepest = -std::numeric_limits<double>::infinity();
  for (const int t : among) {
    const auto weights = tet_coordinates(corners_of(tets[t], places), point);
    const double depth = *std::min_element(weights.begin(), weights.end());
    if (depth > deepest) deepest = depth, best = {tets[t], weights};
  }
  return best;
}

// Data transferred from old tets to new tets.
struct Exchange {
  std::vector<int> gone;         // numbers of the old ones
  std::vector<TetContent> made;  // of the new ones, in their order
};

Exchange exchanged(const ImprovedTets& improved, const std::vector<Tet>& tets, const std::vector<Vec3>& places, const ExchangeableTets& old, const std::vector<Mat3>& elastic) {
  const std::vector<double> volumes = old.volumes(), flow = old.flow();
  std::vector<char> stays(tets.size(), 0);
  for (const int t : improved.kept)
    if (t >= 0) stays[t] = 1;
  Exchange result;
  TetCorners from, to;
  std::vector<TetContent> contents;
  for (size_t t = 0; t < tets.size(); ++t) {
    if (stays[t]) continue;
    result.gone.push_back(static_cast<int>(t));
    from.push_back(corners_of(tets[t], places));
    contents.push_back({volumes[t], hencky_strain(elastic[t]), flow[t]});
  }
  for (size_t t = 0; t < improved.tets.size(); ++t)
    if (improved.kept[t] < 0) to.push_back(corners_of(improved.tets[t], improved.vertices));
  result.made = handed_on(from, contents, to);
  return result;
}

// Where the material of a vertex was when the run began.
Vec3 material_at(const Within& within, const std::vector<Vec3>& material) {
  Vec3 at = Vec3::Zero();
  for (int i = 0; i < 4; ++i) at += within.weights[i] * material[within.vertices[i]];
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

// A vertex that is new belongs to the groups that all corners of the tet belong to in which it lies.
std::map<std::string, std::vector<int>> groups(const Body& body, const NewElements& now) {
  std::map<std::string, std::vector<int>> tags;
  for (const auto& [name, members] : body.tags) {
    const std::set<int> all(members.begin(), members.end());
    std::vector<int>& mine = tags[name];
    for (size_t v = 0; v < now.from.size(); ++v) {
      const Tet& t = now.within[v].vertices;
      const bool belongs = now.from[v] >= 0 ? all.contains(now.from[v]) : std::all_of(t.begin(), t.end(), [&](int w) { return all.contains(w); });
      if (belongs) mine.push_back(static_cast<int>(v));
    }
  }
  return tags;
}

}  // namespace

NewElements new_elements(int index, const Body& body, const ExchangeableTets& old, const VecX& rest, const VecX& x, double goal) {
  const std::vector<Vec3> places = local(body, x), material = local(body, rest);
  const std::vector<Tet> tets = local(body, *old.tets);
  const std::vector<Mat3> elastic = old.elastic(x);
  const std::vector<double> volumes = old.volumes(), flow = old.flow();
  const ImprovedTets improved = improve_tets(places, tets, goal);
  const Exchange exchange = exchanged(improved, tets, places, old, elastic);

  NewElements now{index, {}, improved.vertices, improved.from, {}, {}, improved.before, improved.after};
  for (size_t t = 0, next = 0; t < improved.tets.size(); ++t) {
    const int k = improved.kept[t];
    const Mat3 inverse = edges_of(corners_of(improved.tets[t], improved.vertices)).inverse();
    if (k < 0) {
      const TetContent& made = exchange.made[next++];
      now.mesh.references.push_back({inverse * stretch_of(made.strain), made.volume});
      now.flow.push_back(made.flow);
    } else {
      now.mesh.references.push_back({inverse * elastic[k], volumes[k]});
      now.flow.push_back(flow[k]);
    }
  }
  for (size_t v = 0; v < improved.vertices.size(); ++v) {
    const int w = improved.from[v];
    now.within.push_back(w >= 0 ? Within{} : within(improved.vertices[v], exchange.gone, tets, places));
    now.mesh.mesh.vertices.push_back(w >= 0 ? material[w] : material_at(now.within.back(), material));
  }
  now.mesh.surface = renumbered(local(body, body.triangles), improved.from, places.size());
  now.mesh.mesh.tets = improved.tets;
  now.mesh.mesh.tags = groups(body, now);
  return now;
}

}  // namespace tack
