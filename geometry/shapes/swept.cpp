#include "geometry/shapes/swept.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/errors.hpp"
#include "geometry/shapes/checks.hpp"
#include "geometry/shapes/prism.hpp"

namespace tack {
namespace {

constexpr double turn = 2 * std::numbers::pi, round_off = 1e-9;

double size_of(const std::vector<Vec2>& points) {
  Eigen::AlignedBox2d box;
  for (const Vec2& p : points) box.extend(p);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

// Path of a sweep: stations at which the profile is copied; the first follows the last if it closes.
struct Path {
  int cells = 1;
  bool closes = false, about_axis = false;
  std::function<Vec3(const Vec2&, int)> at;  // position of a point of the profile at a station

  int stations() const { return closes ? cells : cells + 1; }
};

Path circular_path(double angle, int cells) {
  require_positive("revolve", "angle", angle);
  Path path{.cells = cells, .closes = angle > turn * (1 - round_off), .about_axis = true, .at = {}};
  if (angle > turn * (1 + round_off)) throw InputError(fmt::format("revolve: {:g} degrees are more than a turn", angle * 360 / turn));
  const int least = 1 + static_cast<int>(std::floor(angle * (1 + round_off) / std::numbers::pi));  // cells below half a turn
  require_at_least("revolve", "the number of cells around", cells, least);
  path.at = [step = angle / cells](const Vec2& p, int k) -> Vec3 { return {p.x() * std::cos(step * k), p.y(), -p.x() * std::sin(step * k)}; };
  return path;
}

Path straight_path(double length, int cells) {
  require_positive("extrude", "length", length);
  require_at_least("extrude", "the number of cells along the length", cells, 1);
  return {.cells = cells, .closes = false, .about_axis = false,
          .at = [=](const Vec2& p, int k) -> Vec3 { return {p.x(), p.y(), length * (0.5 - double(k) / cells)}; }};
}

// Vertices at all stations; points on the axis have one vertex for all stations.
class Sweep {
 public:
  Sweep(const std::vector<Vec2>& points, const Path& path) : path_(path) {
    require_count(path.about_axis ? "revolve" : "extrude", double(points.size()) * path.stations());
    const double least = round_off * size_of(points);
    for (size_t i = 0; i < points.size(); ++i) {
      if (path.about_axis && points[i].x() < -least)
        throw InputError(fmt::format("revolve: the profile crosses the axis: its point ({:g}, {:g}) m lies on the other side", points[i].x(), points[i].y()));
      on_axis_.push_back(path.about_axis && points[i].x() <= least);
    }
    for (int k = 0; k < path.stations(); ++k) {
      auto& row = vertices_.emplace_back();
      for (size_t i = 0; i < points.size(); ++i) {
        row.push_back(k > 0 && on_axis_[i] ? vertices_[0][i] : static_cast<int>(mesh.vertices.size()));
        if (k == 0 || !on_axis_[i]) mesh.vertices.push_back(path.at(on_axis_[i] ? Vec2(0, points[i].y()) : points[i], k));
      }
    }
    if (path.closes) return;
    for (const auto& [name, row] : {std::pair("start", &vertices_.front()), std::pair("end", &vertices_.back())}) {
      auto& group = mesh.tags[name];
      group = *row;
      std::sort(group.begin(), group.end());
    }
  }

  bool on_axis(size_t point) const { return on_axis_[point]; }
  int vertex(size_t point, int station) const { return vertices_[static_cast<size_t>(station % path_.stations())][point]; }

  Mesh mesh;

 private:
  const Path& path_;
  std::vector<char> on_axis_;
  std::vector<std::vector<int>> vertices_;  // per station, per point of the profile
};

Mesh sheet(std::vector<Vec2> profile, const Path& path) {
  const char* shape = path.about_axis ? "revolve" : "extrude";
  const bool loop = profile.size() > 3 && (profile.front() - profile.back()).norm() <= round_off * size_of(profile);
  if (loop) profile.pop_back();
  if (profile.size() < 2) throw InputError(fmt::format("{}: a profile needs two points or more", shape));
  Sweep sweep(profile, path);
  const size_t points = profile.size(), segments = loop ? points : points - 1;
  for (size_t i = 0; i < points; ++i)
    if (sweep.on_axis(i) && (points == 2 ? sweep.on_axis(1 - i) : loop || (i > 0 && i + 1 < points)))
      throw InputError(fmt::format("{}: the profile touches the axis at ({:g}, {:g}) m, where the sheet would be pinched; only its ends may", shape,
                                   profile[i].x(), profile[i].y()));
  const auto add = [&](const Triangle& t) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) sweep.mesh.triangles.push_back(t);
  };
  for (int k = 0; k < path.cells; ++k) {
    for (size_t i = 0; i < segments; ++i) {
      const size_t j = (i + 1) % points;
      const int a = sweep.vertex(i, k), b = sweep.vertex(i, k + 1), c = sweep.vertex(j, k + 1), d = sweep.vertex(j, k);
      if ((i + static_cast<size_t>(k)) % 2 == 0) add({a, b, c}), add({a, c, d});
      else add({a, b, d}), add({b, c, d});
    }
  }
  return std::move(sweep.mesh);
}

// Throws InputError for a section that touches the axis in a point but not along a side: the solid would be pinched there.
void refuse_pinched(const FlatMesh& section, const Sweep& sweep) {
  std::vector<char> along(section.vertices.size());
  for (const Triangle& t : section.triangles)
    for (int i = 0; i < 3; ++i) {
      const auto a = static_cast<size_t>(t[i]), b = static_cast<size_t>(t[(i + 1) % 3]);
      if (sweep.on_axis(a) && sweep.on_axis(b)) along[a] = along[b] = 1;
    }
  for (size_t i = 0; i < along.size(); ++i)
    if (sweep.on_axis(i) && !along[i])
      throw InputError(fmt::format("revolve: the closed profile touches the axis at ({:g}, {:g}) m in a point, where the solid would be pinched; let it stay away, "
                                   "or have a side on the axis", section.vertices[i].x(), section.vertices[i].y()));
}

Mesh solid(const FlatMesh& section, const Path& path) {
  Sweep sweep(section.vertices, path);
  refuse_pinched(section, sweep);
  for (int k = 0; k < path.cells; ++k) {
    for (Triangle t : section.triangles) {
      std::sort(t.begin(), t.end());
      std::array<int, 3> one, other;
      for (int i = 0; i < 3; ++i) one[i] = sweep.vertex(static_cast<size_t>(t[i]), k), other[i] = sweep.vertex(static_cast<size_t>(t[i]), k + 1);
      add_prism(sweep.mesh, one, other);
    }
  }
  return std::move(sweep.mesh);
}

}  // namespace

std::vector<Vec2> divided(const std::vector<Vec2>& corners, bool closed, int cells) {
  const size_t segments = closed ? corners.size() : corners.size() - 1;
  double total = 0;
  const auto length = [&](size_t i) { return (corners[(i + 1) % corners.size()] - corners[i]).norm(); };
  for (size_t i = 0; i < segments; ++i) total += length(i);
  std::vector<Vec2> points;
  for (size_t i = 0; i < segments; ++i) {
    const int count = std::max(1, static_cast<int>(std::lround(length(i) / total * cells)));
    for (int k = 0; k < count; ++k) points.push_back(corners[i] + double(k) / count * (corners[(i + 1) % corners.size()] - corners[i]));
  }
  if (!closed) points.push_back(corners.back());
  return points;
}

Mesh revolved_sheet(const std::vector<Vec2>& profile, double angle, int cells) { return sheet(profile, circular_path(angle, cells)); }
Mesh extruded_sheet(const std::vector<Vec2>& profile, double length, int cells) { return sheet(profile, straight_path(length, cells)); }
Mesh revolved_solid(const FlatMesh& section, double angle, int cells) { return solid(section, circular_path(angle, cells)); }
Mesh extruded_solid(const FlatMesh& section, double length, int cells) { return solid(section, straight_path(length, cells)); }

}  // namespace tack
