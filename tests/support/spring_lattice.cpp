#include "tests/support/spring_lattice.hpp"

#include <algorithm>
#include <map>

namespace tack {

BlockMatrix spring_lattices(const std::vector<SpringLattice>& bodies, const std::vector<SpringContact>& contacts) {
  static std::uint64_t versions = 1u << 22;
  std::vector<std::map<int, Mat3>> columns;
  std::vector<Vec3> place;
  BlockMatrix matrix;
  const auto add_spring = [&](int one, int other, const Mat3& stiffness) {
    const auto block = [&](int r, int c) -> Mat3& { return columns[c].try_emplace(r, Mat3::Zero()).first->second; };
    block(one, one) += stiffness;
    block(other, other) += stiffness;
    block(std::max(one, other), std::min(one, other)) -= stiffness;
  };
  for (size_t b = 0; b < bodies.size(); ++b) {
    const SpringLattice& body = bodies[b];
    const auto& n = body.nodes;
    const int first = static_cast<int>(columns.size());
    const auto number = [&](int i, int j, int k) { return first + (i * n[1] + j) * n[2] + k; };
    for (int i = 0; i < n[0]; ++i)
      for (int j = 0; j < n[1]; ++j)
        for (int k = 0; k < n[2]; ++k) {
          columns.push_back({{number(i, j, k), body.mass * Mat3::Identity()}});
          place.push_back(body.corner + Vec3(i, j, k));
          matrix.component.push_back(static_cast<int>(b));
        }
    for (int i = 0; i < n[0]; ++i)
      for (int j = 0; j < n[1]; ++j)
        for (int k = 0; k < n[2]; ++k)
          for (int code = 14; code < 27; ++code) {  // half of the 26 around
            const int a = i + code / 9 - 1, c = j + code / 3 % 3 - 1, e = k + code % 3 - 1;
            if (a >= n[0] || std::min(c, e) < 0 || c >= n[1] || e >= n[2]) continue;
            const Vec3 along = (place[number(a, c, e)] - place[number(i, j, k)]).normalized();
            add_spring(number(i, j, k), number(a, c, e), body.stiffness * along * along.transpose());
          }
  }
  for (const SpringContact& contact : contacts)
    add_spring(contact.one, contact.other, contact.stiffness * contact.normal * contact.normal.transpose());

  matrix.version = ++versions;
  matrix.column_start.push_back(0);
  for (const auto& column : columns) {
    for (const auto& [row, block] : column) {
      matrix.row.push_back(row);
      matrix.values.insert(matrix.values.end(), block.data(), block.data() + 9);
    }
    matrix.column_start.push_back(static_cast<int>(matrix.row.size()));
  }
  matrix.positions.resize(matrix.size());
  for (int c = 0; c < matrix.columns(); ++c) matrix.positions.segment<3>(3 * c) = place[c];
  return matrix;
}

}  // namespace tack
