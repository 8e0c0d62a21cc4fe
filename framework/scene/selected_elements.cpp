#include "framework/scene/selected_elements.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/errors.hpp"

namespace tack {

Body selected_elements(const Selection& selection, const SelectionContext& context) {
  Body body = context.body;
  std::vector<char> chosen(static_cast<size_t>(body.vertex_count), 0);
  for (const int v : select(selection, context)) chosen[v - body.first_vertex] = 1;
  const auto out = [&](int v) { return !chosen[v - body.first_vertex]; };
  const auto cut = [&](auto& elements) {
    std::erase_if(elements, [&](const auto& element) { return std::any_of(element.begin(), element.end(), out); });
  };
  cut(body.tets);
  cut(body.triangles);
  cut(body.sheet);
  cut(body.edges);
  std::erase_if(body.points, out);
  if (body.tets.empty() && body.sheet.empty() && body.edges.empty() && body.points.empty())
    throw InputError(fmt::format("the selection {} of an energy of object '{}' holds no whole element; choose all vertices of "
                                 "some", selection.type(), body.name));
  return body;
}

}  // namespace tack
