#include "geometry/mesh/mesh_quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/mesh/quality.hpp"

namespace tack {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

double angle_between(const Vec3& u, const Vec3& v) { return std::atan2(u.cross(v).norm(), u.dot(v)) * degrees; }

void add(AngleHistogram& h, double angle, int element, const Vec3& centroid) {
  ++h.count[std::clamp(static_cast<int>(angle / 10), 0, AngleHistogram::bins - 1)];
  h.largest = std::max(h.largest, angle);
  if (angle >= h.smallest && h.worst >= 0) return;
  h.smallest = angle;
  h.worst = element;
  h.centroid = centroid;
}

std::string position_text(const Vec3& x) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", x[0], x[1], x[2]); }

void add_angles(Notes& notes, const AngleHistogram& h, const char* what, const char* element) {
  notes.push_back(fmt::format("{} from {:.3g} to {:.3g} degrees; smallest in {} {} at {}", what, h.smallest, h.largest, element,
                              h.worst, position_text(h.centroid)));
  const long most = *std::max_element(h.count.begin(), h.count.end());
  for (int i = 0; i < AngleHistogram::bins; ++i)
    if (h.count[i] > 0)
      notes.push_back(fmt::format("  {:3}-{:3} degrees {:>9}  {}", 10 * i, 10 * (i + 1), h.count[i],
                                  std::string(static_cast<std::size_t>((40 * h.count[i] + most - 1) / most), '#')));
}

}  // namespace

AngleHistogram dihedral_angles(const Mesh& mesh) {
  AngleHistogram h;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::array<Vec3, 4> x;
    for (int i = 0; i < 4; ++i) x[i] = mesh.vertices[mesh.tets[t][i]];
    const Vec3 middle = (x[0] + x[1] + x[2] + x[3]) / 4;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        // Dihedral angle at the edge from i to j: between the components, across it, of the vectors to the other two corners.
        const int k = i == 0 ? (j == 1 ? 2 : 1) : 0, l = 6 - i - j - k;
        const Vec3 e = (x[j] - x[i]).normalized();
        const auto across = [&](const Vec3& p) -> Vec3 { return (p - x[i]) - e * e.dot(p - x[i]); };
        add(h, angle_between(across(x[k]), across(x[l])), static_cast<int>(t), middle);
      }
  }
  return h;
}

AngleHistogram triangle_angles(const Mesh& mesh) {
  AngleHistogram h;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const std::array<Vec3, 3> x = {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
    for (int i = 0; i < 3; ++i)
      add(h, angle_between(x[(i + 1) % 3] - x[i], x[(i + 2) % 3] - x[i]), static_cast<int>(t), (x[0] + x[1] + x[2]) / 3);
  }
  return h;
}

EdgeLengths edge_lengths(const Mesh& mesh) {
  std::vector<Edge> edges;
  const auto add_edges = [&](const auto& elements) {
    for (const auto& e : elements)
      for (std::size_t i = 0; i < e.size(); ++i)
        for (std::size_t j = i + 1; j < e.size(); ++j) edges.push_back({std::min(e[i], e[j]), std::max(e[i], e[j])});
  };
  add_edges(mesh.tets);
  add_edges(mesh.triangles);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  if (edges.empty()) return {};
  EdgeLengths l{std::numeric_limits<double>::infinity(), 0, 0};
  for (const auto& [a, b] : edges) {
    const double length = (mesh.vertices[a] - mesh.vertices[b]).norm();
    l.shortest = std::min(l.shortest, length);
    l.longest = std::max(l.longest, length);
    l.mean += length / static_cast<double>(edges.size());
  }
  return l;
}

RadiusEdge radius_edge(const Mesh& mesh) {
  RadiusEdge r;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& [i, j, k, l] = mesh.tets[t];
    const Vec3 &x = mesh.vertices[i], a = mesh.vertices[j] - x, b = mesh.vertices[k] - x, c = mesh.vertices[l] - x;
    const Vec3 centre = (a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b)) /
                        (2 * a.dot(b.cross(c)));
    const double shortest = std::sqrt(std::min({a.squaredNorm(), b.squaredNorm(), c.squaredNorm(), (b - a).squaredNorm(),
                                                (c - a).squaredNorm(), (c - b).squaredNorm()}));
    const double ratio = centre.norm() / shortest;
    if (ratio <= r.largest && r.worst >= 0) continue;
    r.largest = ratio;
    r.worst = static_cast<int>(t);
  }
  return r;
}

Notes quality_notes(const Mesh& mesh) {
  Notes notes;
  if (mesh.tets.empty() && mesh.triangles.empty()) return notes;
  const EdgeLengths l = edge_lengths(mesh);
  notes.push_back(fmt::format("edges from {:.4g} to {:.4g} m, mean {:.4g} m", l.shortest, l.longest, l.mean));
  if (!mesh.tets.empty()) {
    const RadiusEdge r = radius_edge(mesh);
    notes.push_back(fmt::format("{} tets, volume {:.10g} m^3, largest ratio of circumradius to shortest edge {:.3g} (tet {})",
                                mesh.tets.size(), total_volume(mesh), r.largest, r.worst));
    add_angles(notes, dihedral_angles(mesh), "dihedral angles", "tet");
  }
  if (!mesh.triangles.empty()) {
    notes.push_back(fmt::format("{} triangles, area {:.10g} m^2", mesh.triangles.size(), total_area(mesh)));
    add_angles(notes, triangle_angles(mesh), "angles", "triangle");
  }
  return notes;
}

}  // namespace tack
