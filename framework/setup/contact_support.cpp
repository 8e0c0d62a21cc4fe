#include "framework/setup/contact_support.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "geometry/errors.hpp"
#include "geometry/mesh/surface.hpp"

namespace tack {
namespace {

template <class Element>
Element sorted_element(Element e) {
  std::sort(e.begin(), e.end());
  return e;
}

std::vector<int> rods(const Mesh& mesh, const Surface& surface) {
  std::vector<Edge> alone;
  for (const int e : surface.codim_edges) alone.push_back(surface.edges[e]);
  std::vector<int> found;
  for (size_t e = 0; e < mesh.edges.size(); ++e)
    if (std::binary_search(alone.begin(), alone.end(), sorted_element(mesh.edges[e])))
      found.push_back(static_cast<int>(e));
  return found;
}

std::vector<int> particles(const Mesh& mesh, const Surface& surface) {
  std::vector<int> found;
  for (size_t p = 0; p < mesh.points.size(); ++p)
    if (std::binary_search(surface.codim_points.begin(), surface.codim_points.end(), mesh.points[p]))
      found.push_back(static_cast<int>(p));
  return found;
}

// Returns "triangles 4, 5, 6 and 9 more".
std::string listed(const char* kind, const std::vector<int>& numbers) {
  constexpr size_t most = 5;
  const std::vector<int> first(numbers.begin(), numbers.begin() + std::min(most, numbers.size()));
  std::string text = fmt::format("{}{} {}", kind, numbers.size() > 1 ? "s" : "", fmt::join(first, ", "));
  if (numbers.size() > most) text += fmt::format(" and {} more", numbers.size() - most);
  return text;
}

void refuse(const std::string& object, const char* kind, const std::vector<int>& numbers, const char* why) {
  if (numbers.empty()) return;
  throw InputError(fmt::format("object '{}': {} (counted from 0) {}, or remove the contact section", object,
                               listed(kind, numbers), why));
}

}  // namespace

void refuse_unmeasured_contact(const Mesh& mesh, const std::string& object, bool has_section, bool has_radius) {
  if ((mesh.edges.empty() || has_section) && (mesh.points.empty() || has_radius)) return;
  const Surface surface = extract_surface(mesh);
  if (!has_section)
    refuse(object, "edge", rods(mesh, surface), "would be in no contact, as they have no width: give the object a section "
           "(rod: {radius: ...})");
  if (!has_radius)
    refuse(object, "point", particles(mesh, surface), "would be in no contact, as they have no size: give the object a radius "
           "(particle: {radius: ...})");
}

std::string unsupported_text(const ContactPotential& potential, std::string_view model, ContactFeature feature, const PairSetup& pair, const std::vector<std::string>& objects) {
  const std::string reason = potential.refusal(feature, pair);
  if (reason.empty()) return "";
  const auto [name, remedy] = [&]() -> std::pair<const char*, const char*> {
    switch (feature) {
      case ContactFeature::adhesion: return {"adhesion of the gap", "take `adhesion` away"};
      case ContactFeature::tangential_adhesion: return {"tangential_adhesion", "take it away"};
      case ContactFeature::bonds: return {"adhesion by bonds", potential.refusal(ContactFeature::adhesion, pair).empty() ? "choose an adhesion of the gap" : "take `adhesion` away"};
      case ContactFeature::regions: return {"regions of objects", "name whole objects"};
      case ContactFeature::integration_side: return {"`integrate`", "take it away"};
      case ContactFeature::both_sides: return {"`integrate: both`", "name one side, or leave it out"};
      case ContactFeature::barrier: return {"`barrier`", "take it away"};
      case ContactFeature::rods: return {"rods", "make the object a surface or a solid"};
      case ContactFeature::particles: return {"particles", "make the object a surface or a solid"};
    }
    return {"", ""};
  }();
  std::string where;
  if (objects.size() == 1) where = fmt::format(", and object '{}' has some", objects[0]);
  if (objects.size() == 2) where = fmt::format(" between '{}' and '{}'", objects[0], objects[1]);
  return fmt::format("contact.model: {} has no {}{}: {}; {}, or choose model: area_integral", model, name, where, reason, remedy);
}

}  // namespace tack
