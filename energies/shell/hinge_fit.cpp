#include "energies/shell/hinge_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <tuple>

#include "framework/assembly/symmetric_eigen.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr int most_sweeps = 40;
constexpr double met = 1e-4;    // of the moments, what conditions may be off in the mean
constexpr double least = 0.05;  // of D: what no C falls below, in angles over the width of a hinge

constexpr double damping = 0.01;  // of a change, so that conditions that hardly depend on C, at corners, do not drive it off

using Mat36 = Eigen::Matrix<double, 3, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

struct HalfEdge {
  Edge key;
  int triangle, edge;
};

// Curvatures are (K_xx, K_xy, K_yy), in a frame of the triangle or of an edge (along the normal n and the edge t).
Vec3 of_normal(const Vec2& n) { return {n.x() * n.x(), n.x() * n.y(), n.y() * n.y()}; }

// The slope of w = K(x, x)/2 from the edge a b to the apex of a triangle that interpolates it, in the frame of the edge:
// its origin in a, t along the edge, n towards the apex.
Vec3 slope(const Vec3& a, const Vec3& b, const Vec3& apex) {
  const Vec3 along = b - a;
  const double length = along.norm(), foot = along.dot(apex - a) / length, height = along.cross(apex - a).norm() / length;
  return {height / 2, foot, foot * (foot - length) / (2 * height)};
}

struct Flat {
  double area;
  std::array<Vec2, 3> normal;   // of the edges, away from the triangle, in its frame
  std::array<double, 3> width;  // of the hinges: (A + A_i) / l_i; that of the triangle alone at borders
  std::array<Vec3, 3> turn;     // c_i / width: how far K, in the frame of the triangle, turns the hinges
};

class Fit {
 public:
  Fit(const std::vector<SheetTriangle>& sheet, const VecX& rest, double poisson) : sheet_(sheet), rest_(rest) {
    material_ << 1, 0, poisson, 0, 2 * (1 - poisson), 0, poisson, 0, 1;
    measure();
    begin();
  }

  // In units of D.
  std::vector<Mat3> solve() {
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      for (size_t t = 0; t < sheet_.size(); ++t) make_definite(t);
      double sum = 0;
      int hinges = 0;
      for (size_t t = 0; t < sheet_.size(); ++t)
        for (int i = 0; i < 3; ++i)
          if (sheet_[t].neighbour[i] > static_cast<int>(t)) sum += meet(static_cast<int>(t), i), ++hinges;
      if (sum <= met * met * hinges) break;
    }
    std::vector<Mat3> out(sheet_.size());
    for (size_t t = 0; t < sheet_.size(); ++t) {
      make_definite(t);
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) out[t](i, k) = flat_[t].area * c_[t](i, k) / (flat_[t].width[i] * flat_[t].width[k]);
    }
    return out;
  }

 private:
  Vec3 at(int v) const { return vertex(rest_, v); }
  bool border(size_t t, int i) const { return sheet_[t].neighbour[i] < 0; }

  // The edge of the neighbour of t at its edge i.
  int edge_across(int t, int i) const {
    const SheetTriangle& n = sheet_[static_cast<size_t>(sheet_[t].neighbour[i])];
    for (int k = 0; k < 3; ++k)
      if (n.neighbour[k] == t && n.vertices[k] == sheet_[t].across[i]) return k;
    return -1;
  }

  void measure() {
    flat_.resize(sheet_.size());
    for (size_t t = 0; t < sheet_.size(); ++t) {
      const SheetTriangle& s = sheet_[t];
      const Vec3 a = at(s.vertices[0]), x = (at(s.vertices[1]) - a).normalized();
      const Vec3 normal = (at(s.vertices[1]) - a).cross(at(s.vertices[2]) - a);
      const Vec3 y = normal.normalized().cross(x);
      flat_[t].area = normal.norm() / 2;
      for (int i = 0; i < 3; ++i) {
        const Vec3 p = at(s.vertices[(i + 1) % 3]), q = at(s.vertices[(i + 2) % 3]);
        const Vec2 along(x.dot(q - p), y.dot(q - p));
        flat_[t].normal[i] = Vec2(along.y(), -along.x()).normalized();
      }
    }
    for (size_t t = 0; t < sheet_.size(); ++t) {
      const SheetTriangle& s = sheet_[t];
      for (int i = 0; i < 3; ++i) {
        const Vec3 p = at(s.vertices[(i + 1) % 3]), q = at(s.vertices[(i + 2) % 3]);
        if (border(t, i)) {
          flat_[t].width[i] = flat_[t].area / (q - p).norm();
          flat_[t].turn[i] = Vec3::Zero();
          continue;
        }
        flat_[t].width[i] = (flat_[t].area + flat_[static_cast<size_t>(s.neighbour[i])].area) / (q - p).norm();
        // In the frame of the hinge, n points away from this triangle: on this side K_nt counts the other way.
        const Vec3 here = slope(p, q, at(s.vertices[i])), there = slope(p, q, at(s.across[i]));
        const Vec3 jump(here(0) + there(0), there(1) - here(1), here(2) + there(2));
        flat_[t].turn[i] = to_edge(flat_[t].normal[i]).transpose() * jump / flat_[t].width[i];
      }
    }
  }

  // (K_nn, K_nt, K_tt) of K, t along the edge: the normal turned by a right angle.
  static Mat3 to_edge(const Vec2& n) {
    Mat3 m;
    m << n.x() * n.x(), 2 * n.x() * n.y(), n.y() * n.y(),                       //
        -n.x() * n.y(), n.x() * n.x() - n.y() * n.y(), n.x() * n.y(),           //
        n.y() * n.y(), -2 * n.x() * n.y(), n.x() * n.x();
    return m;
  }

  // K = sum_i a_i / width_i n_i n_i^T, borders condensed: no moment acts there.
  void begin() {
    c_.resize(sheet_.size());
    for (size_t t = 0; t < sheet_.size(); ++t) {
      Mat3 b;
      for (int i = 0; i < 3; ++i) b.col(i) = of_normal(flat_[t].normal[i]);
      c_[t] = b.transpose() * material_ * b;
      for (int i = 0; i < 3; ++i)
        if (border(t, i) && c_[t](i, i) > 0) c_[t] -= Vec3(c_[t].col(i)) * Vec3(c_[t].col(i)).transpose() / c_[t](i, i);
      clear_borders(t);
    }
  }

  bool same_direction(int t, int i, int other, int k) const {
    return sheet_[t].vertices[(i + 1) % 3] == sheet_[other].vertices[(k + 1) % 3];
  }

  void clear_borders(size_t t) {
    for (int i = 0; i < 3; ++i) {
      if (!border(t, i)) continue;
      c_[t].row(i).setZero();
      c_[t].col(i).setZero();
    }
  }

  void make_definite(size_t t) {
    for (int i = 0; i < 3; ++i)
      if (border(t, i)) c_[t](i, i) = 1;
    const SymmetricEigen<3> eigen(c_[t]);
    if (eigen.values().minCoeff() < least) {
      c_[t] = eigen.vectors() * eigen.values().cwiseMax(least).asDiagonal() * eigen.vectors().transpose();
      c_[t] = (0.5 * (c_[t] + c_[t].transpose())).eval();
    }
    clear_borders(t);
  }

  // Makes hinge i of t meet its conditions; what they were off by, squared.
  double meet(int t, int i) {
    const int other = sheet_[t].neighbour[i], k = edge_across(t, i);
    const std::array<int, 2> sides = {t, other}, edge = {i, k};
    const double area = flat_[t].area + flat_[other].area;
    Mat36 a = Mat36::Zero();
    Vec6 stiffness, weight;
    Mat3 allowed = Mat3::Identity();
    for (int s = 0; s < 2; ++s) {
      const Flat& flat = flat_[sides[s]];
      // From the frame of that triangle to that of the hinge, whose n and t both point the other way on the other side; of a
      // neighbour that is oriented otherwise, t and what is up do.
      const Vec2 n = flat.normal[edge[s]];
      Mat3 turned = to_edge(Vec2(n.x(), -n.y())).transpose();
      if (s == 1 && same_direction(t, i, other, k)) turned.row(1) *= -1;
      for (int j = 0; j < 3; ++j) {
        const int column = 3 * s + j;
        a.col(column) = turned * flat.turn[j] * flat.area / area;
        stiffness(column) = c_[sides[s]](edge[s], j);
        weight(column) = j == edge[s] ? 1 : 0.5;
        if (border(static_cast<size_t>(sides[s]), j)) exclude(turned * material_ * of_normal(flat.normal[j]), allowed);
      }
    }
    const Vec3 moment = Vec3(material_(0, 0), 0, material_(0, 2));
    const Vec3 off = allowed * (a * stiffness - moment);
    a = (allowed * a).eval();
    Mat3 normal = a * weight.asDiagonal() * a.transpose();
    normal.diagonal().array() += damping;
    const Vec6 change = -weight.cwiseProduct(a.transpose() * normal.inverse() * off);
    for (int s = 0; s < 2; ++s)
      for (int j = 0; j < 3; ++j) {
        if (border(static_cast<size_t>(sides[s]), j)) continue;
        Mat3& c = c_[sides[s]];
        c(edge[s], j) += change(3 * s + j);
        if (j != edge[s]) c(j, edge[s]) = c(edge[s], j);
      }
    return off.squaredNorm();
  }

  // Leaves out of the conditions the curvatures along q.
  static void exclude(const Vec3& q, Mat3& allowed) {
    const Vec3 left = allowed * q;
    if (left.norm() > 1e-9) allowed -= left * left.transpose() / left.squaredNorm();
  }

  const std::vector<SheetTriangle>& sheet_;
  const VecX& rest_;
  Mat3 material_;  // moments of curvatures: M_xx, 2 M_xy, M_yy
  std::vector<Flat> flat_;
  std::vector<Mat3> c_;  // of angles over widths, per area
};

}  // namespace

std::vector<SheetTriangle> connect_sheet(const std::vector<Triangle>& sheet, const std::string& who) {
  std::vector<HalfEdge> edges;
  std::vector<SheetTriangle> out;
  for (size_t t = 0; t < sheet.size(); ++t) {
    out.push_back({sheet[t], {-1, -1, -1}, {-1, -1, -1}});
    for (int i = 0; i < 3; ++i) {
      const int a = sheet[t][(i + 1) % 3], b = sheet[t][(i + 2) % 3];
      edges.push_back({{std::min(a, b), std::max(a, b)}, static_cast<int>(t), i});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.key, a.triangle, a.edge) < std::tie(b.key, b.triangle, b.edge);
  });
  for (size_t first = 0, last = 0; first < edges.size(); first = last) {
    while (last < edges.size() && edges[last].key == edges[first].key) ++last;
    if (last - first > 2)
      throw InputError(fmt::format("{}{} triangles of its sheet share an edge (triangles {}, {} and {} among them), and a hinge joins "
                                   "two; divide the sheet, or select a part of it", who, last - first, edges[first].triangle,
                                   edges[first + 1].triangle, edges[first + 2].triangle));
    if (last - first < 2) continue;
    for (int s = 0; s < 2; ++s) {
      const HalfEdge &here = edges[first + static_cast<size_t>(s)], &there = edges[first + 1 - static_cast<size_t>(s)];
      out[static_cast<size_t>(here.triangle)].across[here.edge] = sheet[static_cast<size_t>(there.triangle)][there.edge];
      out[static_cast<size_t>(here.triangle)].neighbour[here.edge] = there.triangle;
    }
  }
  return out;
}

std::vector<Mat3> fit_hinges(const std::vector<SheetTriangle>& sheet, const VecX& rest, double stiffness, double poisson) {
  std::vector<Mat3> fitted = Fit(sheet, rest, poisson).solve();
  for (Mat3& c : fitted) c *= stiffness;
  return fitted;
}

}  // namespace tack
