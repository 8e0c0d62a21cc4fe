// Plastic part of the bending of a sheet: areas and yield moments of its fans, history variables and plastic work (dihedral_term.hpp).
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "energies/shell/dihedral_term.hpp"
#include "framework/core/records.hpp"

namespace tack {
namespace {

double triangle_area(const Triangle& t, const VecX& x) {
  return (vertex(x, t[1]) - vertex(x, t[0])).cross(vertex(x, t[2]) - vertex(x, t[0])).norm() / 2;
}

// Returns the areas of the fans [m^2]. Each triangle is shared evenly by its dihedral edges, and each dihedral edge by the fans of its ends.
std::vector<double> fan_areas(const std::vector<SheetTriangle>& sheet, const std::vector<DihedralFan>& fans, const VecX& rest) {
  std::vector<double> share;  // of a triangle, for one end of one of its dihedral edges
  for (const SheetTriangle& t : sheet) {
    const auto edges = std::count_if(t.neighbour.begin(), t.neighbour.end(), [](int n) { return n >= 0; });
    share.push_back(edges > 0 ? triangle_area(t.vertices, rest) / (2 * static_cast<double>(edges)) : 0);
  }
  std::vector<double> areas;
  for (const DihedralFan& fan : fans) {
    double sum = 0;
    for (int i = 0; i < fan.shape.edge_count; ++i)
      sum += share[static_cast<size_t>(fan.triangles[fan.shape.left_triangle(i)])] + share[static_cast<size_t>(fan.triangles[fan.shape.right_triangle(i)])];
    areas.push_back(sum);
  }
  return areas;
}

}  // namespace

void DihedralTerm::set_yield(const Yielding& y) {
  angles_name_ = fmt::format("{}/energies/{}/plastic_angles", y.body.name, y.body.energy);
  curvature_name_ = fmt::format("{}/energies/{}/plastic_curvature", y.body.name, y.body.energy);
  std::vector<double> yields;
  for (const double a : fan_areas(y.sheet, y.fans, y.rest)) {
    flow_scale_.push_back(std::sqrt(y.stiffness * a));
    yields.push_back(y.plastic.yield_moment * std::sqrt(a / y.stiffness));
  }
  const double* first = yields.data();
  for (FanStencils& shape : fans_) {
    shape.set_yield(first, y.plastic.hardening / y.stiffness);
    first += shape.count();
  }
  plastic_angles_.assign(turns_.size(), 0.0);
  plastic_curvature_.assign(flow_scale_.size(), 0.0);
}

void DihedralTerm::load_flow(const History& history) {
  if (flow_scale_.empty()) return;
  const auto load = [&](const std::string& name, std::vector<double>& values) {
    if (const auto* stored = history_values(history, name, 1, static_cast<int>(values.size()))) values = *stored;
    else std::fill(values.begin(), values.end(), 0.0);
  };
  load(angles_name_, plastic_angles_);
  load(curvature_name_, plastic_curvature_);
  std::vector<double> flow(plastic_curvature_.size());
  for (size_t f = 0; f < flow.size(); ++f) flow[f] = plastic_curvature_[f] * flow_scale_[f];
  size_t edge = 0, fan = 0;
  for (FanStencils& shape : fans_) {
    shape.set_flow({&plastic_angles_[edge], &flow[fan]});
    edge += static_cast<size_t>(shape.edge_count());
    fan += static_cast<size_t>(shape.count());
  }
}

void DihedralTerm::commit_flow(const VecX& x, History& history) const {
  if (flow_scale_.empty()) return;
  std::vector<double> angles(plastic_angles_.size()), flow(plastic_curvature_.size());
  size_t edge = 0, fan = 0;
  for (const FanStencils& shape : fans_) {
    shape.flow(x, &angles[edge], &flow[fan]);
    edge += static_cast<size_t>(shape.edge_count());
    fan += static_cast<size_t>(shape.count());
  }
  for (size_t f = 0; f < flow.size(); ++f) flow[f] /= flow_scale_[f];
  history[angles_name_] = {1, std::move(angles), {}};
  history[curvature_name_] = {1, std::move(flow), {}};
}

void DihedralTerm::publish(Records& records) const {
  Term::publish(records);
  if (flow_scale_.empty()) return;
  records.add(FlowRecord{name(), {{"dissipated_plastic"}}, [this](const VecX& x, double* amounts) {
    amounts[0] = 0;
    for (const FanStencils& shape : fans_) amounts[0] += shape.dissipated(x);
  }});
}

}  // namespace tack
