#include "python/bindings/force_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "framework/core/force_point.hpp"

namespace tack::python {
namespace {

using Numbers3 = std::array<double, 3>;

// A row of the array; unused vertices are -1, with weight 0.
struct Row {
  int object, opposite;
  std::array<int, 3> vertices, opposite_vertices;
  Numbers3 weights, opposite_weights;
  Numbers3 point, opposite_point, normal;
  double gap, area, normal_force;
  Numbers3 force;
};

Numbers3 numbers(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Row row_of(const ForcePoint& p, const VecX& x) {
  Row row{};
  row.object = p.object;
  row.opposite = p.opposite;
  row.vertices = row.opposite_vertices = {-1, -1, -1};
  for (int i = 0; i < static_cast<int>(p.vertices.size()); ++i) {
    const bool own = i < p.own_vertex_count;
    const size_t at = static_cast<size_t>(own ? i : i - p.own_vertex_count);
    (own ? row.vertices : row.opposite_vertices)[at] = p.vertices[i];
    (own ? row.weights : row.opposite_weights)[at] = own ? p.coefficients[i] : -p.coefficients[i];
  }
  row.point = numbers(p.point(x));
  row.opposite_point = numbers(p.opposite_point(x));
  row.normal = numbers(p.normal);
  row.gap = p.gap;
  row.area = p.area;
  row.normal_force = p.normal_force;
  row.force = numbers(p.force);
  return row;
}

// Throws for a summand that no force record of the name has.
void check_summand(const World& world, const std::string& name, const std::string& summand) {
  std::vector<std::string> known;
  for (const ForceRecord& force : world.records.forces())
    if (force.name == name) known.insert(known.end(), force.summands.begin(), force.summands.end());
  if (summand.empty() || std::find(known.begin(), known.end(), summand) != known.end()) return;
  throw py::value_error(fmt::format("'{}' has no part '{}'; it has {}", name, summand, fmt::join(known, ", ")));
}

}  // namespace

py::array force_points(const World& world, const VecX& x, const std::string& name, const std::string& summand) {
  [[maybe_unused]] static const bool registered = [] {  // once
    PYBIND11_NUMPY_DTYPE(Row, object, opposite, vertices, opposite_vertices, weights, opposite_weights, point, opposite_point, normal, gap, area, normal_force, force);
    return true;
  }();
  std::vector<Row> rows;
  std::vector<std::string> known;
  for (const Term* term : world.terms) {
    const auto* points = dynamic_cast<const ForcePoints*>(term);
    if (!points || world.records.replaced(*term)) continue;
    if (std::find(known.begin(), known.end(), term->name()) == known.end()) known.push_back(term->name());
    if (term->name() != name) continue;
    check_summand(world, name, summand);
    points->visit_points(x, summand, [&](const ForcePoint& p) { rows.push_back(row_of(p, x)); });
  }
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw py::value_error(fmt::format("no force '{}' acts at points between surfaces in this scene; {}", name,
                                      known.empty() ? "it has none that does" : fmt::format("there are {}", fmt::join(known, ", "))));
  return py::array_t<Row>(static_cast<py::ssize_t>(rows.size()), rows.data());
}

}  // namespace tack::python
