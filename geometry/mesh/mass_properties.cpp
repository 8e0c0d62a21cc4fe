#include "geometry/mesh/mass_properties.hpp"

#include <fmt/format.h>

#include <map>

#include "geometry/errors.hpp"
#include "geometry/mesh/nesting.hpp"
#include "geometry/mesh/oriented_surface.hpp"

namespace tack {
namespace {

// Sums over tets, whose volumes may be negative.
struct Sums {
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();

  void add(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const double v = (b - a).dot((c - a).cross(d - a)) / 6;
    const Vec3 sum = a + b + c + d;
    volume += v;
    first += v / 4 * sum;
    second += v / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + d * d.transpose() + sum * sum.transpose());
  }
};

constexpr const char* by_repair = "`tack mesh repair MESH -o NEW`, or `repair` among the steps of a shape `processed`";

// Throws InputError unless every edge is used once in each direction.
void check_closed(const std::vector<Triangle>& triangles) {
  std::map<Edge, int> uses;
  for (const Triangle& t : triangles)
    for (int i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      if (++uses[{a, b}] > 1)
        throw InputError(fmt::format("its triangles are not oriented alike at the edge ({}, {}), or more than two meet "
                                     "there; repair the surface ({}), or give tets", a, b, by_repair));
    }
  for (const auto& [edge, unused] : uses)
    if (!uses.count({edge[1], edge[0]}))
      throw InputError(fmt::format("its surface is not closed (edge ({}, {}) has one triangle), so it encloses no volume; "
                                   "close it ({}), weld vertices that nearly coincide (`weld` of the shape), or give tets", edge[0], edge[1], by_repair));
}

// Throws InputError if a component inside another one is not a cavity, or a component inside a cavity faces inwards: space would
// count twice.
void check_nesting(const Mesh& mesh) {
  const std::vector<int> component = components_by_edges(mesh.triangles);
  const auto at = [&](int v) { return mesh.vertices[v]; };
  const std::vector<int> around = enclosing_windings(mesh.triangles, component, at);
  if (around.size() < 2) return;
  std::vector<double> volume(around.size(), 0);
  std::vector<int> first(around.size(), -1);
  for (size_t t = 0; t < component.size(); ++t) {
    int& vertex = first[component[t]];
    if (vertex < 0) vertex = mesh.triangles[t][0];
    const auto x = [&](int k) { return Vec3(at(mesh.triangles[t][k]) - at(vertex)); };
    volume[component[t]] += x(0).dot(x(1).cross(x(2)));
  }
  for (size_t p = 0; p < around.size(); ++p) {
    const bool outwards = volume[p] > 0;
    if (around[p] == (outwards ? 0 : 1)) continue;
    throw InputError(outwards ? fmt::format("has a closed surface within another, that of its vertex {}, and what is within both would count twice; take it out, or "
                                            "turn its triangles inwards if it is a cavity", first[p])
                              : fmt::format("has a closed surface that faces inwards and bounds no cavity, that of its vertex {}; turn its triangles outwards", first[p]));
  }
}

}  // namespace

MassProperties mass_properties(const Mesh& mesh) {
  if (mesh.tets.empty() && mesh.triangles.empty())
    throw InputError("has neither tets nor triangles, so it encloses no volume");
  const Vec3 near = mesh.vertices[mesh.tets.empty() ? mesh.triangles[0][0] : mesh.tets[0][0]];
  const auto x = [&](int v) { return Vec3(mesh.vertices[v] - near); };
  Sums sums;
  for (const Tet& t : mesh.tets) sums.add(x(t[0]), x(t[1]), x(t[2]), x(t[3]));
  if (mesh.tets.empty()) {
    check_closed(mesh.triangles);
    for (const Triangle& t : mesh.triangles) sums.add(Vec3::Zero(), x(t[0]), x(t[1]), x(t[2]));
    if (!(sums.volume > 0))
      throw InputError(fmt::format("its surface encloses {:.3g} m^3; turn its triangles outwards", sums.volume));
    check_nesting(mesh);
  }
  const Vec3 centroid = sums.first / sums.volume;
  return {sums.volume, near + centroid, sums.second - sums.volume * centroid * centroid.transpose()};
}

}  // namespace tack
