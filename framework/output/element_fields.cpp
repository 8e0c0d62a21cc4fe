#include "framework/output/element_fields.hpp"

#include <cmath>
#include <limits>
#include <map>

#include "framework/scene/world.hpp"

namespace tack {
namespace {

double von_mises(const Mat3& stress) {
  const Mat3 deviator = stress - stress.trace() / 3 * Mat3::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

// Calls act(term, the first cell of its body) for each term whose elements are the tets of a body.
template <class Act>
void for_each_solid(const World& world, const Act& act) {
  std::vector<int> first = {0};  // tets come first, body by body
  for (const Body& body : world.bodies) first.push_back(first.back() + static_cast<int>(body.tets.size()));
  for (const auto& term : world.elastic_terms) {
    const auto batches = term->batches();
    if (batches.size() != 1 || batches[0].arity != 4) continue;
    const int vertex = batches[0].vertices[0];
    if (vertex < world.mesh_vertex_count()) act(*term, first[world.body_of(vertex)]);  // else of an affine body
  }
}

VecX von_mises_stress(const World& world, const VecX& x, VecX values) {
  std::map<int, std::vector<Mat3>> sums;  // by the first cell of a body
  for_each_solid(world, [&](const Term& term, int first) {
    const auto stress = term.cauchy_stress(x);
    auto& sum = sums[first];
    sum.resize(stress.size(), Mat3::Zero());
    for (size_t t = 0; t < stress.size(); ++t) sum[t] += stress[t];
  });
  for (const auto& [first, stress] : sums)
    for (size_t t = 0; t < stress.size(); ++t) values(first + static_cast<Eigen::Index>(t)) = von_mises(stress[t]);
  return values;
}

VecX plastic_strain(const World& world, VecX values) {
  for_each_solid(world, [&](const Term& term, int first) {
    const auto strain = term.plastic_strain();
    for (size_t t = 0; t < strain.size(); ++t) {
      double& value = values(first + static_cast<Eigen::Index>(t));
      value = std::fmax(value, strain[t]);
    }
  });
  return values;
}

}  // namespace

std::vector<CellField> element_fields(const std::vector<std::string>& names, const World& world, const VecX& x,
                                      const FrameGeometry& geometry) {
  const VecX none = VecX::Constant(geometry.cells(), std::numeric_limits<double>::quiet_NaN());
  std::vector<CellField> fields;
  for (const std::string& name : names) {
    if (name == "von_mises_stress") fields.push_back({name, von_mises_stress(world, x, none), "Pa"});
    if (name == "plastic_strain") fields.push_back({name, plastic_strain(world, none), ""});
  }
  return fields;
}

}  // namespace tack
