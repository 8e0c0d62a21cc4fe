#include "framework/body/chamber_surface.hpp"

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
constexpr double next_to_nothing = 1e-9;

struct Chosen {
  std::vector<Triangle> faces, sheet;
};

Chosen chosen_triangles(const Selection& selection, const SelectionContext& context) {
  const Body& body = context.body;
  const ChosenVertices chosen(body, select(selection, context));
  Chosen found;
  const size_t faces = body.triangles.size() - body.sheet.size();
  for (size_t i = 0; i < body.triangles.size(); ++i) {
    const Triangle& t = body.triangles[i];
    if (!chosen.whole(t)) continue;
    (i < faces ? found.faces : found.sheet).push_back(t);
  }
  if (found.faces.empty() && found.sheet.empty())
    throw InputError(fmt::format("the selection {} holds no whole triangle of the surface of object '{}'; widen it", selection.type(), body.name));
  if (!found.faces.empty() && !found.sheet.empty())
    throw InputError(fmt::format("the selection {} holds faces of solids and sheets of object '{}'; give each a load of its own", selection.type(), body.name));
  return found;
}

std::vector<Triangle> turned(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
  return triangles;
}

std::vector<Triangle> of_part(const std::vector<Triangle>& triangles, const std::vector<int>& parts, int part) {
  std::vector<Triangle> kept;
  for (size_t t = 0; t < triangles.size(); ++t)
    if (parts[t] == part) kept.push_back(triangles[t]);
  return kept;
}

int count_of(const std::vector<int>& parts) { return parts.empty() ? 0 : *std::max_element(parts.begin(), parts.end()) + 1; }

// Each piece that is closed, so that its normals lead out of it; others as they are.
std::vector<Triangle> outwards(const std::vector<Triangle>& triangles, const VecX& rest) {
  const std::vector<int> parts = parts_of(triangles);
  std::vector<Triangle> all;
  for (int p = 0; p < count_of(parts); ++p) {
    std::vector<Triangle> piece = of_part(triangles, parts, p);
    const OrientedSurface surface(piece);
    if (surface.closed() && surface.volume(rest, surface.mean_place(rest)) < 0) piece = turned(std::move(piece));
    all.insert(all.end(), piece.begin(), piece.end());
  }
  return all;
}

// Turns triangles so that neighbours are oriented alike; false, and nothing turned, where there is no such orientation.
bool orient(std::vector<Triangle>& triangles) {
  try {
    triangles = oriented_alike(triangles);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

std::string place_of_loop(const std::vector<int>& loop, const VecX& rest) {
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

// Joins the boundaries two by two, nearest first, with the triangles that it returns.
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
    throw InputError(fmt::format("{}: its surface has a boundary that nothing closes, {}; add the part that lies opposite", who,
                                 place_of_loop(loops.front(), rest)));
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

ChamberPart chamber_part(const Selection& selection, const SelectionContext& context) {
  Chosen chosen = chosen_triangles(selection, context);
  if (!chosen.faces.empty()) return {turned(std::move(chosen.faces)), true};
  return {std::move(chosen.sheet), false};
}

std::vector<Triangle> pressed_triangles(const Selection& selection, const SelectionContext& context) {
  ChamberPart part = chamber_part(selection, context);
  try {
    return part.solid ? part.triangles : outwards(oriented_alike(std::move(part.triangles)), context.rest);
  } catch (const InputError& error) {
    throw InputError(fmt::format("the surface of object '{}': {}", context.body.name, error.what()));
  }
}

ExposedTriangles exposed_triangles(const Selection& selection, const SelectionContext& context) {
  const Body& body = context.body;
  const ChosenVertices chosen(body, select(selection, context));
  ExposedTriangles exposed;
  const auto take = [&](const std::vector<Triangle>& triangles, std::vector<Triangle>& to) {
    std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(to), [&](const Triangle& t) { return chosen.whole(t); });
  };
  const auto first_sheet = body.triangles.end() - static_cast<std::ptrdiff_t>(body.sheet.size());
  for (const bool solid : {true, false}) {
    const std::vector<Triangle> all(solid ? body.triangles.begin() : first_sheet, solid ? first_sheet : body.triangles.end());
    const std::vector<int> pieces = parts_of(all);
    for (int p = 0; p < count_of(pieces); ++p) {
      std::vector<Triangle> piece = of_part(all, pieces, p);
      if (!solid && !orient(piece)) {
        take(piece, exposed.open);
        continue;
      }
      const OrientedSurface surface(piece);
      const double volume = surface.volume(context.rest, surface.mean_place(context.rest));
      if (!solid && !surface.closed()) take(piece, exposed.open);
      else if (volume > 0) take(piece, exposed.closed);
      else if (!solid) take(turned(std::move(piece)), exposed.closed);
    }
  }
  return exposed;
}

ChamberSurface chamber_surface(const std::vector<ChamberPart>& parts, const VecX& rest, const std::string& who) {
  std::vector<Triangle> all;
  std::vector<Triangle> slits;
  std::set<Triangle> faces;
  for (const ChamberPart& part : parts) {
    all.insert(all.end(), part.triangles.begin(), part.triangles.end());
    if (part.solid) faces.insert(part.triangles.begin(), part.triangles.end());
  }
  try {
    all = oriented_alike(std::move(all));
    slits = slits_between(all, rest, who);
    all.insert(all.end(), slits.begin(), slits.end());
    all = outwards(oriented_alike(std::move(all)), rest);
  } catch (const InputError& error) {
    const std::string what = error.what();
    throw what.starts_with(who) ? InputError(what) : InputError(fmt::format("{}: {}", who, what));
  }
  // One piece may lie within another, and is then the inner boundary of what they enclose.
  const std::vector<int> pieces = parts_of(all);
  const std::vector<int> around = enclosing_windings(all, pieces, [&](int v) -> Vec3 { return vertex(rest, v); });
  std::vector<Triangle> turned_out;
  for (int p = 0; p < count_of(pieces); ++p) {
    std::vector<Triangle> piece = of_part(all, pieces, p);
    const bool inner = around[p] % 2 != 0;
    const int given = sense(piece, faces, who);
    if (inner && given > 0)
      throw InputError(fmt::format("{}: a cavity lies within another part of its surface, and would count twice; choose one of them", who));
    if (inner || given < 0) piece = turned(std::move(piece));
    turned_out.insert(turned_out.end(), piece.begin(), piece.end());
  }
  const OrientedSurface surface(turned_out);
  const double volume = surface.volume(rest, surface.mean_place(rest)), area = surface.area(rest);
  if (!(volume > next_to_nothing * area * std::sqrt(area)))
    throw InputError(fmt::format("{}: its surface encloses {:.3g} m^3 at rest; {}", who, volume,
                                 volume < 0 ? "it is on the wrong side of the faces of solids: choose those of a cavity" : "leave room between its parts"));
  return {std::move(turned_out), std::move(slits)};
}

}  // namespace tack
