#include "energies/rod/edges.hpp"

#include <fmt/format.h>

#include "geometry/errors.hpp"

namespace tack {

const RodSection& section_of(const Body& body, std::string_view energy) {
  if (body.edges.empty())
    throw InputError(fmt::format("object '{}': the energy {} needs explicit edges, and its shape has none; use a shape or mesh of "
                                 "edges", body.name, energy));
  if (!body.section)
    throw InputError(fmt::format("object '{}': the energy {} needs the section of the edges; give `rod: {{radius: ...}}`, or "
                                 "`rod: {{width: ..., height: ..., normal: ...}}`", body.name, energy));
  return *body.section;
}

double edge_length(const Edge& edge, const VecX& rest) { return (vertex(rest, edge[1]) - vertex(rest, edge[0])).norm(); }

void add_edge_mass(const Body& body, const VecX& rest, double density, VecX& mass) {
  for (const Edge& e : body.edges)
    for (const int v : e) mass(v) += density * body.section->area() * edge_length(e, rest) / 2;
}

}  // namespace tack
