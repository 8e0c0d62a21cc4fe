#include "framework/body/selected_elements.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/body/chosen_vertices.hpp"
#include "geometry/errors.hpp"
#include "geometry/tets/divide_tets.hpp"

namespace tack {
namespace {

// Keeps the composite tets (eight tets each) with all corners chosen.
template <class Out>
void keep_composite(std::vector<Tet>& tets, const Out& out) {
  const std::vector<CompositeTet> all = composite_tets_of(tets);
  std::vector<Tet> kept;
  for (size_t t = 0; t < all.size(); ++t) {
    if (std::any_of(all[t].begin(), all[t].begin() + 4, out)) continue;
    const auto first = tets.begin() + static_cast<std::ptrdiff_t>(composite_parts * t);
    kept.insert(kept.end(), first, first + composite_parts);
  }
  tets = std::move(kept);
}

}  // namespace

Body selected_elements(const Selection& selection, const SelectionContext& context) {
  Body body = context.body;
  const ChosenVertices chosen(body, select(selection, context));
  const auto out = [&](int v) { return !chosen.has(v); };
  const auto cut = [&](auto& elements) { std::erase_if(elements, [&](const auto& element) { return !chosen.contains(element); }); };
  if (body.elements == Elements::composite) keep_composite(body.tets, out);
  else cut(body.tets);
  cut(body.triangles);
  cut(body.sheet);
  cut(body.edges);
  std::erase_if(body.points, out);
  if (body.tets.empty() && body.sheet.empty() && body.edges.empty() && body.points.empty())
    throw InputError(fmt::format("the selection {} of an energy of object '{}' has no complete element; choose all vertices of "
                                 "some", selection.type(), body.name));
  return body;
}

}  // namespace tack
