#include "framework/contact/clipped/close_triangles.hpp"

#include "framework/contact/clipped/clipped_pair.hpp"

namespace tack {
namespace {

using Corner = std::array<Pack, 3>;

Pack lesser(const Pack& a, const Pack& b) { return select(a < b, a, b); }
Pack greater(const Pack& a, const Pack& b) { return select(b < a, a, b); }
Pack least(const Pack& a, const Pack& b, const Pack& c) { return lesser(lesser(a, b), c); }
Pack largest(const Pack& a, const Pack& b, const Pack& c) { return greater(greater(a, b), c); }

Corner between(const Corner& from, const Corner& to) { return {to[0] - from[0], to[1] - from[1], to[2] - from[2]}; }
Pack dot(const Corner& a, const Corner& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Corner cross(const Corner& a, const Corner& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Pack length(const Corner& a) { return sqrt(dot(a, a)); }

// Returns a bound of the change of the unit normal of a triangle with these edges: of u = v / |v|, by a
// change of v of length d it is 2 d / (2 |v| - d) at most.
Pack turn_of(const Corner& first, const Corner& second, const Pack& twice_area, double motion) {
  const Pack change = 2 * motion * (length(first) + length(second)) + 4 * motion * motion;
  const PackMask bounded = change < twice_area;
  return select(bounded, 2 * change / select(bounded, 2 * twice_area - change, 1), 2);
}

}  // namespace

void CloseTriangles::set(int lane, const VecX& x, const std::array<int, 6>& vertices, double range, bool two_sided) {
  for (int k = 0; k < 6; ++k)
    for (int d = 0; d < 3; ++d) corner_[3 * k + d][lane] = x[3 * vertices[k] + d];
  range_[lane] = range;
  two_sided_[lane] = two_sided;
}

CloseTriangles::Lanes CloseTriangles::test() const {
  Corner corners[6];
  for (int k = 0; k < 6; ++k)
    for (int d = 0; d < 3; ++d) std::memcpy(&corners[k][d], corner_[3 * k + d], sizeof(Pack));
  Pack range, is_two_sided;
  std::memcpy(&range, range_, sizeof range);
  std::memcpy(&is_two_sided, two_sided_, sizeof is_two_sided);
  const PackMask two_sided = is_two_sided > 0.5;
  const Corner *a = corners, *b = corners + 3;

  const Corner first = between(b[0], b[1]), second = between(b[0], b[2]), normal_b = cross(first, second);
  const Pack twice_area = length(normal_b);
  const PackMask flat = twice_area <= 0;
  const Pack by_area = 1 / select(flat, 1, twice_area);
  const Pack turn_b = turn_of(first, second, twice_area, motion_), slack = 2 * motion_ + range * turn_b;
  Pack height[3];
  for (int k = 0; k < 3; ++k) height[k] = dot(normal_b, between(b[0], a[k])) * by_area;
  PackMask apart = (largest(height[0], height[1], height[2]) < -slack - select(two_sided, range, 0)) |
                   (least(height[0], height[1], height[2]) > range + slack);

  // Two triangles of a plane are apart by more than the slack if one of their lines separates them so.
  // Distances are times the length of the edge.
  PackMask inside = ~flat;
  for (int e = 0; e < 3; ++e) {
    const Corner edge = between(b[e], b[(e + 1) % 3]), inward = cross(normal_b, edge);
    Pack from_line[3];
    for (int k = 0; k < 3; ++k) from_line[k] = dot(inward, between(b[e], a[k])) * by_area;
    const Pack margin = slack * length(edge);
    apart |= largest(from_line[0], from_line[1], from_line[2]) < -margin;
    inside &= least(from_line[0], from_line[1], from_line[2]) > margin;
  }
  for (int e = 0; e < 3; ++e) {
    const Corner edge = between(a[e], a[(e + 1) % 3]), across = cross(normal_b, edge);
    const Pack along = dot(edge, normal_b) * by_area, in_plane = sqrt(greater(dot(edge, edge) - along * along, 0));
    const Pack own = dot(across, between(a[e], a[(e + 2) % 3])) * by_area;
    Pack at[3];
    for (int k = 0; k < 3; ++k) at[k] = dot(across, between(a[e], b[k])) * by_area;
    apart |= (least(at[0], at[1], at[2]) > greater(own, 0) + slack * in_plane) |
             (largest(at[0], at[1], at[2]) < lesser(own, 0) - slack * in_plane);
  }

  const Corner first_a = between(a[0], a[1]), second_a = between(a[0], a[2]), normal_a = cross(first_a, second_a);
  const Pack twice_area_a = length(normal_a), facing = -dot(normal_a, normal_b) * by_area;
  apart |= ~two_sided & (facing < (clip_cosine_min - turn_of(first_a, second_a, twice_area_a, motion_) - turn_b) * twice_area_a);

  Lanes lanes;
  for (int l = 0; l < pack_width; ++l) {
    if (flat[l] || !apart[l]) lanes.close |= 1u << l;
    if (inside[l]) lanes.inside |= 1u << l;
  }
  return lanes;
}

}  // namespace tack
