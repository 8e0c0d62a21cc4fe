#include "energies/shell/sheet_geometry.hpp"

#include <fmt/format.h>

#include <Eigen/LU>

#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"

namespace tack {

void require_sheet(const Body& body, const VecX& rest, std::string_view energy) {
  if (body.sheet.empty())
    throw InputError(fmt::format("object '{}': {} acts on triangles, and its shape has none but faces of tets; use a sheet "
                                 "(shape: grid, or a mesh of triangles)", body.name, energy));
  if (!(body.thickness > 0))
    throw InputError(fmt::format("object '{}': {} needs the thickness of its sheet; give the object `shell: {{thickness: ...}}`",
                                 body.name, energy));
  for (size_t t = 0; t < body.sheet.size(); ++t) {
    const auto [a, b, c] = corners(rest, body.sheet[t]);
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if (!(triangle_area(a, b, c) > 1e-12 * longest * longest))
      throw InputError(fmt::format("object '{}': triangle {} has no area at rest; repair the mesh", body.name, t));
  }
}

Mat32 sheet_frame(const Triangle& triangle, const VecX& rest) {
  const auto [a, b, c] = corners(rest, triangle);
  Mat32 frame;
  frame.col(0) = (b - a).normalized();
  frame.col(1) = (b - a).cross(c - a).normalized().cross(frame.col(0));
  return frame;
}

std::vector<SheetRest<double>> sheet_rest_data(const Body& body, const VecX& rest) {
  std::vector<SheetRest<double>> data;
  data.reserve(body.sheet.size());
  for (const Triangle& t : body.sheet) {
    const auto [a, b, c] = corners(rest, t);
    Mat32 edges;
    edges << b - a, c - a;
    const Mat2 flat = sheet_frame(t, rest).transpose() * edges;
    data.push_back({flat.inverse(), body.thickness * flat.determinant() / 2});
  }
  return data;
}

void add_sheet_mass(const Body& body, const VecX& rest, double density, VecX& mass) {
  for (const Triangle& t : body.sheet) {
    const auto [a, b, c] = corners(rest, t);
    for (const int v : t) mass(v) += density * body.thickness * triangle_area(a, b, c) / 3;
  }
}

}  // namespace tack
