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
  ImprovedTets improved = improve_tets(places, tets, goal);
  NewElements now;
  now.body = index;
  now.before = improved.before;
  now.after = improved.after;

  const std::vector<Mat3> elastic = old.elastic(x);
  const std::vector<double> volumes = old.volumes(), flow = old.flow();
  std::vector<char> stays(tets.size(), 0);
  for (const int t : improved.kept)
    if (t >= 0) stays[t] = 1;
  std::vector<int> gone;
  TetCorners from, to;
  std::vector<TetContent> contents;
  for (size_t t = 0; t < tets.size(); ++t) {
    if (stays[t]) continue;
    gone.push_back(static_cast<int>(t));
    from.push_back(corners_of(tets[t], places));
    contents.push_back({volumes[t], hencky_strain(elastic[t]), flow[t]});
  }
  for (size_t t = 0; t < improved.tets.size(); ++t)
    if (improved.kept[t] < 0) to.push_back(corners_of(improved.tets[t], improved.vertices));
  const std::vector<TetContent> made = handed_on(from, contents, to);

  for (size_t t = 0, next = 0; t < improved.tets.size(); ++t) {
    const int k = improved.kept[t];
    const TetContent* content = k < 0 ? &made[next++] : nullptr;
    const Mat3 f = content ? stretch_of(content->strain) : elastic[k];
    now.mesh.references.push_back({edges_of(corners_of(improved.tets[t], improved.vertices)).inverse() * f, content ? content->volume : volumes[k]});
    now.flow.push_back(content ? content->flow : flow[k]);
  }

  for (size_t v = 0; v < improved.vertices.size(); ++v) {
    const int w = improved.from[v];
    now.within.push_back(w >= 0 ? Within{} : within(improved.vertices[v], gone, tets, places));
    Vec3 at = Vec3::Zero();
    if (w >= 0) at = material[w];
    else for (int i = 0; i < 4; ++i) at += now.within.back().weights[i] * material[now.within.back().vertices[i]];
    now.mesh.mesh.vertices.push_back(at);
  }
  std::vector<int> number(places.size(), -1);  // of vertices before, now
  for (size_t v = 0; v < improved.from.size(); ++v)
    if (improved.from[v] >= 0) number[improved.from[v]] = static_cast<int>(v);
  now.mesh.surface = local(body, body.triangles);
  for (Triangle& t : now.mesh.surface)
    for (int& v : t) v = number[v];
  now.mesh.mesh.tets = std::move(improved.tets);
  now.places = std::move(improved.vertices);
  now.from = std::move(improved.from);
  now.mesh.mesh.tags = groups(body, now);
  return now;
}

}  // namespace tack
