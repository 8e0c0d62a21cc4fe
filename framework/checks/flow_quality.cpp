#include "framework/checks/flow_quality.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>

#include "geometry/tets/mean_ratio.hpp"

namespace tack {
namespace {

constexpr double poor_quality = 0.1;  // of that at rest
constexpr double flowed = 0.1;        // plastic strain, from which on it is flow that has given it its shape

double mean_ratio_without_stress(const TetReference& reference) {
  const Mat3 edges = reference.shape.inverse();
  return mean_ratio({Vec3::Zero(), edges.col(0), edges.col(1), edges.col(2)});
}

}  // namespace

FlowQuality::FlowQuality(const World& world) : world_(world) {
  for (const FieldRecord& field : world.records.fields()) {
    if (field.name != "plastic_strain" || !field.tets || field.tets->empty()) continue;
    Flowing flowing{&field, world.body_of(field.tets->front()[0]), {}};
    const Body& body = world.bodies[flowing.body];
    for (size_t t = 0; t < field.tets->size(); ++t)
      flowing.at_rest.push_back(body.references.empty() ? mean_ratio((*field.tets)[t], world.rest) : mean_ratio_without_stress(body.references[t]));
    all_.push_back(std::move(flowing));
  }
}

void FlowQuality::examine(const VecX& x, double time) {
  for (Flowing& f : all_) {
    const VecX strain = f.strain->values(x);
    for (size_t t = 0; t < f.at_rest.size(); ++t) {
      if (!(strain(static_cast<Eigen::Index>(t)) > flowed)) continue;
      const Tet& tet = (*f.strain->tets)[t];
      const double quality = mean_ratio(tet, x) / f.at_rest[t];
      lowest_ = std::min(lowest_.value_or(quality), quality);
      if (quality >= f.lowest) continue;
      f.lowest = quality;
      f.time = time;
      f.plastic_strain = strain(static_cast<Eigen::Index>(t));
      f.tet = static_cast<int>(t);
      f.place = (vertex(x, tet[0]) + vertex(x, tet[1]) + vertex(x, tet[2]) + vertex(x, tet[3])) / 4;
    }
  }
}

std::vector<Warning> FlowQuality::warnings() const {
  std::vector<Warning> warnings;
  for (const Flowing& f : all_) {
    if (f.lowest >= poor_quality) continue;
    warnings.emplace_back(WarningKind::flattened_elements, fmt::format(
        "object '{}': plastic flow has made its elements flat or long: of tet {} at ({:.4g}, {:.4g}, {:.4g}) m, with a plastic strain of {:.2g}, the "
        "mean ratio is {:.2g} of what it was at rest (t = {:.4g} s), and below {:g} shapes and forces there are the mesh's more than the body's; finer cells there, "
        "shorter than what flow stretches them to, or go on from a mesh of the flowed shape (tack mesh remesh)",
        world_.bodies[f.body].name, f.tet, f.place.x(), f.place.y(), f.place.z(), f.plastic_strain, f.lowest, f.time, poor_quality));
  }
  return warnings;
}

}  // namespace tack
