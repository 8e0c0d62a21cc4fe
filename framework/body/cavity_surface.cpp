#include "framework/body/cavity_surface.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <limits>
#include <set>

#include "framework/body/chosen_vertices.hpp"
#include "geometry/errors.hpp"
#include "geometry/mesh/nesting.hpp"

namespace tack {
namespace {

// Enclosed volume that counts as zero, as a fraction of the volume of a ball of equal area.
constexpr double volume_fraction_min = 1e-9;

struct ChosenTriangles {
  std::vector<Triangle> faces, sheet;  // of solids, of sheets
};

ChosenTriangles chosen_triangles(const Selection& selection, const SelectionContext& context) {
  const Body& body = context.body;
  const ChosenVertices chosen(body, select(selection, context));
  ChosenTriangles found;
  const size_t faces = body.triangles.size() - body.sheet.size();
  for (size_t i = 0; i < body.triangles.size(); ++i) {
    const Triangle& t = body.triangles[i];
    if (!chosen.contains(t)) continue;
    (i < faces ? found.faces : found.sheet).push_back(t);
  }
  if (found.faces.empty() && found.sheet.empty())
    throw InputError(fmt::format("the selection {} has no complete triangle of the surface of object '{}'; widen it", selection.type(), body.name));
  if (!found.faces.empty() && !found.sheet.empty())
    throw InputError(fmt::format("the selection {} has faces of solids and of sheets of object '{}'; give each a load of its own", selection.type(), body.name));
  return found;
}

std::vector<Triangle> reversed(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
  return triangles;
}

std::vector<Triangle> of_component(const std::vector<Triangle>& triangles, const std::vector<int>& components, int component) {
  std::vector<Triangle> kept;
  for (size_t t = 0; t < triangles.size(); ++t)
    if (components[t] == component) kept.push_back(triangles[t]);
  return kept;
}

int count_of(const std::vector<int>& components) { return components.empty() ? 0 : *std::max_element(components.begin(), components.end()) + 1; }

// Reverses closed connected components whose normals point inwards.
std::vector<Triangle> outwards(const std::vector<Triangle>& triangles, const VecX& rest) {
  const std::vector<int> components = components_by_edges(triangles);
  std::vector<Triangle> all;
  for (int i = 0; i < count_of(components); ++i) {
    std::vector<Triangle> component = of_component(triangles, components, i);
    const OrientedSurface surface(component);
    if (surface.closed() && surface.volume(rest, surface.mean_position(rest)) < 0) component = reversed(std::move(component));
    all.insert(all.end(), component.begin(), component.end());
  }
  return all;
}

// Orients triangles consistently. Returns false, with triangles unchanged, if that is impossible.
bool orient(std::vector<Triangle>& triangles) {
  try {
    triangles = consistently_oriented(triangles);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

std::string describe_loop(const std::vector<int>& loop, const VecX& rest) {
  Vec3 mean = Vec3::Zero();
  for (const int v : loop) mean += vertex(rest, v) / static_cast<double>(loop.size());
  return fmt::format("one of {} edges around ({:.4g}, {:.4g}, {:.4g}) m", loop.size(), mean.x(), mean.y(), mean.z());
}

double least_distance(const std::vector<int>& a, const std::vector<int>& b, const VecX& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const int u : a)
    for (const int v : b) least = std::min(least, (vertex(x, u) - vertex(x, v)).squaredNorm());
  return least;
}

// Returns triangles that close the slits between pairs of boundary loops, nearest loops first.
std::vector<Triangle> slits_between(const std::vector<Triangle>& triangles, const VecX& rest, const std::string& who) {
  std::vector<std::vector<int>> loops = boundary_loops(triangles);
  std::vector<Triangle> slits;
  while (loops.size() > 1) {
    size_t first = 0, second = 1;
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < loops.size(); ++i)
      for (size_t j = 0; j < i; ++j)
        if (const double d = least_distance(loops[i], loops[j], rest); d < least) least = d, first = i, second = j;
    const std::vector<Triangle> strip = stitched(loops[first], loops[second], rest);
    slits.insert(slits.end(), strip.begin(), strip.end());
    loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(std::max(first, second)));
    loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(std::min(first, second)));
  }
  if (!loops.empty())
    throw InputError(fmt::format("{}: its surface has a boundary that nothing closes, {}; add the opposite wall", who,
                                 describe_loop(loops.front(), rest)));
  return slits;
}

// Returns the orientation of the faces of solids among the triangles: 1 as given, -1 all reversed, 0 without such faces.
int sense(const std::vector<Triangle>& triangles, const std::set<Triangle>& faces, const std::string& who) {
  int found = 0;
  for (const Triangle& t : triangles) {
    const auto known = [&](Triangle r) {
      for (int k = 0; k < 3; ++k, std::rotate(r.begin(), r.begin() + 1, r.end()))
        if (faces.contains(r)) return true;
      return false;
    };
    const int here = known(t) ? 1 : known({t[0], t[2], t[1]}) ? -1 : 0;
    if (here * found < 0) throw InputError(fmt::format("{}: it would be on both sides of the faces of solids; choose those that face it", who));
    if (here != 0) found = here;
  }
  return found;
}

}  // namespace

CavityWall cavity_wall(const Selection& selection, const SelectionContext& context) {
  ChosenTriangles chosen = chosen_triangles(selection, context);
  if (!chosen.faces.empty()) return {reversed(std::move(chosen.faces)), true};
  return {std::move(chosen.sheet), false};
}

std::vector<Triangle> pressed_triangles(const Selection& selection, const SelectionContext& context) {
  CavityWall wall = cavity_wall(selection, context);
  try {
    return wall.solid ? wall.triangles : outwards(consistently_oriented(std::move(wall.triangles)), context.rest);
  } catch (const InputError& error) {
    throw InputError(fmt::format("the surface of object '{}': {}", context.body.name, error.what()));
  }
}

ExposedTriangles exposed_triangles(const Selection& selection, const SelectionContext& context) {
  const Body& body = context.body;
  const ChosenVertices chosen(body, select(selection, context));
  ExposedTriangles exposed;
  const auto take = [&](const std::vector<Triangle>& triangles, std::vector<Triangle>& to) {
    std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(to), [&](const Triangle& t) { return chosen.contains(t); });
  };
  const auto first_sheet = body.triangles.end() - static_cast<std::ptrdiff_t>(body.sheet.size());
  for (const bool solid : {true, false}) {
    const std::vector<Triangle> all(solid ? body.triangles.begin() : first_sheet, solid ? first_sheet : body.triangles.end());
    const std::vector<int> components = components_by_edges(all);
    for (int p = 0; p < count_of(components); ++p) {
      std::vector<Triangle> component = of_component(all, components, p);
      if (!solid && !orient(component)) {
        take(component, exposed.open);
        continue;
      }
      const OrientedSurface surface(component);
      const double volume = surface.volume(context.rest, surface.mean_position(context.rest));
      if (!solid && !surface.closed()) take(component, exposed.open);
      else if (volume > 0) take(component, exposed.closed);
      else if (!solid) take(reversed(std::move(component)), exposed.closed);
    }
  }
  return exposed;
}

CavitySurface cavity_surface(const std::vector<CavityWall>& walls, const VecX& rest, const std::string& who) {
  std::vector<Triangle> all;
  std::vector<Triangle> slits;
  std::set<Triangle> faces;
  for (const CavityWall& wall : walls) {
    all.insert(all.end(), wall.triangles.begin(), wall.triangles.end());
    if (wall.solid) faces.insert(wall.triangles.begin(), wall.triangles.end());
  }
  try {
    all = consistently_oriented(std::move(all));
    slits = slits_between(all, rest, who);
    all.insert(all.end(), slits.begin(), slits.end());
    all = outwards(consistently_oriented(std::move(all)), rest);
  } catch (const InputError& error) {
    const std::string what = error.what();
    throw what.starts_with(who) ? InputError(what) : InputError(fmt::format("{}: {}", who, what));
  }
  // A component within another one is the inner boundary of the enclosed volume.
  const std::vector<int> components = components_by_edges(all);
  const std::vector<int> enclosing = enclosing_windings(all, components, [&](int v) -> Vec3 { return vertex(rest, v); });
  std::vector<Triangle> oriented;
  for (int p = 0; p < count_of(components); ++p) {
    std::vector<Triangle> component = of_component(all, components, p);
    const bool inner = enclosing[p] % 2 != 0;
    const int given_sense = sense(component, faces, who);
    if (inner && given_sense > 0)
      throw InputError(fmt::format("{}: a cavity lies within another wall, and would count twice; choose one of them", who));
    if (inner || given_sense < 0) component = reversed(std::move(component));
    oriented.insert(oriented.end(), component.begin(), component.end());
  }
  const OrientedSurface surface(oriented);
  const double volume = surface.volume(rest, surface.mean_position(rest)), area = surface.area(rest);
  if (!(volume > volume_fraction_min * area * std::sqrt(area)))
    throw InputError(fmt::format("{}: its surface encloses {:.3g} m^3 at rest; {}", who, volume,
                                 volume < 0 ? "it is on the wrong side of the faces of solids: choose those of a cavity" : "leave space between its walls"));
  return {std::move(oriented), std::move(slits)};
}

}  // namespace tack
