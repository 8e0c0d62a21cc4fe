#include "energies/shell/dihedral_stiffness.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "framework/assembly/symmetric_eigen.hpp"

namespace tack {
namespace {

constexpr int most_sweeps = 200, first_sweeps = 50;
constexpr int few_edges = 6;      // initial limit of the edges of a fan
constexpr double met = 1e-3;      // tolerated mean error of the conditions, relative to the moments
constexpr double enough = 2e-3;   // mean error after all sweeps with which small fans suffice
constexpr double hopeful = 0.01;  // mean error after the first sweeps with which small fans are iterated further
constexpr double least = 0.01;    // lower bound of C over D, in angles over the width of a dihedral edge. It is smaller, by the square, if
constexpr double regular = 6;     // triangles are so long that curvatures turn dihedral edges by more than this, squared, of that width
constexpr double lift = 3;        // times the lower bound: eigenvalues below the bound are raised to it
constexpr double beside = 0.05;   // initial stiffness over D against angles of no curvature
constexpr double evenly = 0.5;    // uniform fraction of a change of C; the rest is in proportion to C
constexpr double damping = 1e-6;  // relative damping of changes by conditions that hardly depend on C, at corners

using Rows = Eigen::Matrix<double, fan_edges_max, 3>;
using Row = Eigen::Matrix<double, fan_edges_max, 1>;

// Curvatures are (K_nn, K_nt, K_tt), t along an edge and n to its left, or (K_xx, K_xy, K_yy). Returns the matrix from the latter
// to the former.
Mat3 to_edge(const Vec2& t) {
  Mat3 m;
  m << t.y() * t.y(), -2 * t.x() * t.y(), t.x() * t.x(),                       //
      -t.x() * t.y(), t.x() * t.x() - t.y() * t.y(), t.x() * t.y(),            //
      t.x() * t.x(), 2 * t.x() * t.y(), t.y() * t.y();
  return m;
}

// Position of an apex: along the edge from its first vertex, and across it.
struct Apex {
  double foot, height;

  Apex(const Vec3& a, const Vec3& b, const Vec3& apex) {
    const Vec3 along = b - a;
    const double length = along.norm();
    foot = along.dot(apex - a) / length;
    height = along.cross(apex - a).norm() / length;
  }
  // Returns the slope of the interpolated w = K(x, x)/2 from the edge to the apex, n towards the apex.
  Vec3 slope(double length) const { return {height / 2, foot, foot * (foot - length) / (2 * height)}; }
};

// Angles and moments of a fan, scaled by the root of length over width of their dihedral edge, so that C has the size of D.
struct ScaledFan {
  Rows turn = Rows::Zero();                // turns by a curvature of the fan
  std::array<double, fan_edges_max> root{};  // of length over width
  std::array<Mat3, fan_edges_max> edge;      // to_edge of each dihedral edge
  double least = 0;                        // lower bound of C
  FanMatrix metric;                        // metric of changes of C
};

struct End {
  int fan, edge;
};

// The conditions of a dihedral edge at both ends, in the frame of the first end.
struct Conditions {
  std::array<End, 2> ends;
  std::array<Rows, 2> turn;
  Vec3 moment;
  Mat3 inverse;
};

class Fit {
 public:
  // proportional: to C, changes are in part; that converges where triangles are long, and is slower where they are not.
  Fit(const std::vector<SheetTriangle>& sheet, const std::vector<DihedralFan>& fans, const VecX& rest, double poisson, bool proportional)
      : sheet_(sheet), fans_(fans), rest_(rest), proportional_(proportional) {
    material_ << 1, 0, poisson, 0, 2 * (1 - poisson), 0, poisson, 0, 1;
    for (const DihedralFan& fan : fans_) begin(fan);
    find_dihedral_edges();
  }

  // Does at most so many sweeps. Afterwards each C is definite, and error() is the mean error of the
  // conditions.
  void solve(int sweeps) {
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      double sum = 0;
      for (size_t h = 0; h < edges_.size(); ++h) sum += meet(h);
      int lifted = 0;
      for (size_t f = 0; f < fans_.size(); ++f) lifted += make_definite(f);
      if (lifted == 0 && sum <= met * met * static_cast<double>(edges_.size())) break;
    }
  }

  double error() const {
    double sum = 0;
    for (const Conditions& c : edges_) sum += error(c).squaredNorm();
    return std::sqrt(sum / static_cast<double>(edges_.size()));
  }

  // [J], for D = stiffness.
  std::vector<FanMatrix> matrices(double stiffness) const {
    std::vector<FanMatrix> out = c_;
    for (size_t f = 0; f < fans_.size(); ++f)
      for (int i = 0; i < fan_edges_max; ++i)
        for (int k = 0; k < fan_edges_max; ++k) out[f](i, k) *= stiffness * scaled_[f].root[i] * scaled_[f].root[k];
    return out;
  }

 private:
  Vec3 at(const DihedralFan& fan, int k) const { return vertex(rest_, fan.vertices[static_cast<size_t>(k)]); }

  void begin(const DihedralFan& fan) {
    const auto& [closed, n] = fan.shape;
    const Vec3 middle = at(fan, 0);
    // Directions of the ring, unrolled.
    std::array<double, ring_max + 1> angle{};
    const int triangles = fan.shape.triangles();
    for (int j = 0; j < triangles; ++j) {
      const Vec3 a = at(fan, 1 + j) - middle, b = at(fan, 1 + (j + 1) % fan.shape.ring()) - middle;
      angle[j + 1] = angle[j] + std::atan2(a.cross(b).norm(), a.dot(b));
    }
    const double scale = closed ? 2 * std::numbers::pi / angle[triangles] : 1;
    ScaledFan s;
    Rows moment = Rows::Zero();  // of a unit of mean curvature, for one end
    double area = 0;
    for (int i = 0; i < n; ++i) {
      const double direction = scale * angle[fan.shape.tip(i) - 1];
      s.edge[i] = to_edge({std::cos(direction), std::sin(direction)});
      const Vec3 tip = at(fan, fan.shape.tip(i));
      const double length = (tip - middle).norm();
      const Apex left(middle, tip, at(fan, fan.shape.left(i))), right(middle, tip, at(fan, fan.shape.right(i)));
      const double width = (left.height + right.height) / 2;
      s.root[i] = std::sqrt(length / width);
      const Vec3 l = left.slope(length), r = right.slope(length);
      // n points away from the right side, where K_nt has the other sign.
      s.turn.row(i) = Vec3(l(0) + r(0), l(1) - r(1), l(2) + r(2)).transpose() * s.edge[i] * s.root[i];
      const Vec3 nn(s.edge[i](0, 0), s.edge[i](0, 1) / 2, s.edge[i](0, 2));
      moment.row(i) = (length / (2 * s.root[i])) * nn.transpose();
      area += length * width;
    }
    const Mat3 square = s.turn.transpose() * s.turn;
    s.least = tack::least * std::pow(std::min(1.0, regular * area / square.trace()), 2);
    area = std::max((s.turn.transpose() * moment).trace() / 3, area / 12);
    FanMatrix c = moment * material_ * moment.transpose() / area;
    // Angles orthogonal to those of curvatures.
    const SymmetricEigen<3> eigen(square);
    FanMatrix rest = FanMatrix::Identity();
    for (int k = 0; k < 3; ++k) {
      if (eigen.values()(k) < 0.04 * eigen.values().maxCoeff()) continue;
      const Row along = s.turn * eigen.vectors().col(k) / std::sqrt(eigen.values()(k));
      rest -= along * along.transpose();
    }
    s.metric = FanMatrix::Identity();
    if (proportional_) s.metric = (c + evenly * s.metric).eval();
    c += beside * rest;
    clear_beyond(c, n);
    c_.push_back(c);
    scaled_.push_back(s);
  }

  // Beyond the dihedral edges of a fan, C is the identity.
  static void clear_beyond(FanMatrix& c, int n) {
    for (int i = n; i < fan_edges_max; ++i) {
      c.row(i).setZero();
      c.col(i).setZero();
      c(i, i) = 1;
    }
  }

  void find_dihedral_edges() {
    struct HalfEdge {
      Edge key;
      End end;
    };
    std::vector<HalfEdge> all;
    for (size_t f = 0; f < fans_.size(); ++f) {
      for (int i = 0; i < fans_[f].shape.edge_count; ++i) {
        const int a = fans_[f].vertices[0], b = fans_[f].vertices[static_cast<size_t>(fans_[f].shape.tip(i))];
        all.push_back({{std::min(a, b), std::max(a, b)}, {static_cast<int>(f), i}});
      }
    }
    std::sort(all.begin(), all.end(), [](const HalfEdge& a, const HalfEdge& b) {
      return std::tie(a.key, a.end.fan, a.end.edge) < std::tie(b.key, b.end.fan, b.end.edge);
    });
    for (size_t k = 0; k + 1 < all.size(); k += 2) edges_.push_back(conditions({all[k].end, all[k + 1].end}));
  }

  Conditions conditions(const std::array<End, 2>& ends) {
    Conditions out{ends, {}, {}, {}};
    std::array<Rows, 2> weighted;
    const DihedralFan &fan = fans_[ends[0].fan], &other = fans_[ends[1].fan];
    const int i = ends[0].edge, k = ends[1].edge, tip = fan.shape.tip(i);
    const double length = (at(fan, tip) - at(fan, 0)).norm(), root = scaled_[ends[0].fan].root[i];
    const double unit = length / root;  // the root of length times width
    // At the other end t and n are reversed. If the fans have opposite orientations, t alone is reversed.
    const bool turned = fan.triangles[fan.shape.left_triangle(i)] != other.triangles[other.shape.right_triangle(k)];
    Mat3 allowed = Mat3::Identity();
    for (const bool left : {true, false})
      leave_borders_out(sheet_[fan.triangles[left ? fan.shape.left_triangle(i) : fan.shape.right_triangle(i)]], fan.vertices[0],
                        fan.vertices[tip], left, allowed);
    Mat3 normal = damping * Mat3::Identity();
    for (int s = 0; s < 2; ++s) {
      Mat3 seen = scaled_[ends[s].fan].edge[ends[s].edge].inverse();
      if (s == 1 && turned) seen.col(1) *= -1;
      out.turn[s] = scaled_[ends[s].fan].turn * (seen * allowed) / unit;
      const FanMatrix& metric = scaled_[ends[s].fan].metric;
      weighted[s] = metric * out.turn[s];
      const Vec3 own = weighted[s].row(ends[s].edge).transpose();
      normal += (metric(ends[s].edge, ends[s].edge) * (out.turn[s].transpose() * weighted[s]) + own * own.transpose()) / 2;
    }
    out.moment = allowed * Vec3(material_(0, 0), 0, material_(0, 2));
    out.inverse = normal.inverse();
    if (proportional_) weighted_.push_back(weighted);
    return out;
  }

  // Excludes curvatures that need a moment at the borders of a triangle beside the edge from a to b.
  void leave_borders_out(const SheetTriangle& t, int a, int b, bool left, Mat3& allowed) const {
    const auto is = [](int v) { return [v](int w) { return w == v; }; };
    const auto place = [&](int v) { return std::find_if(t.vertices.begin(), t.vertices.end(), is(v)) - t.vertices.begin(); };
    const int c = t.vertices[static_cast<size_t>(3 - place(a) - place(b))];
    const Vec3 xa = vertex(rest_, a), xb = vertex(rest_, b);
    const Apex apex(xa, xb, vertex(rest_, c));
    const double length = (xb - xa).norm(), height = left ? apex.height : -apex.height;
    const std::array<std::pair<int, Vec2>, 2> edges = {std::pair(b, Vec2(height, apex.foot)), {a, Vec2(height, apex.foot - length)}};
    for (const auto& [opposite, along] : edges) {  // (n, t)
      if (t.neighbour[place(opposite)] >= 0) continue;
      const Vec2 across = Vec2(along.y(), -along.x()).normalized();
      const Vec3 q = allowed * material_ * Vec3(across.x() * across.x(), across.x() * across.y(), across.y() * across.y());
      if (q.norm() > 1e-6) allowed -= q * q.transpose() / q.squaredNorm();
    }
  }

  bool make_definite(size_t f) {
    FanMatrix& c = c_[f];
    const double low = scaled_[f].least;
    if (above(low, c, fans_[f].shape.edge_count)) return false;
    const SymmetricEigen<fan_edges_max> eigen(c);
    const Row& values = eigen.values();
    if (!(values.minCoeff() < low)) return false;
    c = eigen.vectors() * (values.array() < low).select(Row::Constant(lift * low), values).asDiagonal() * eigen.vectors().transpose();
    c = (0.5 * (c + c.transpose())).eval();
    clear_beyond(c, fans_[f].shape.edge_count);
    return true;
  }

  // Returns true if C - low is positive definite: its Cholesky factorisation succeeds.
  static bool above(double low, FanMatrix a, int n) {
    for (int k = 0; k < n; ++k) {
      const double pivot = a(k, k) - low;
      if (!(pivot > 0)) return false;
      for (int j = k + 1; j < n; ++j) {
        const double factor = a(j, k) / pivot;
        for (int i = j; i < n; ++i) a(i, j) -= factor * a(i, k);
      }
    }
    return true;
  }

  Vec3 error(const Conditions& h) const {
    Vec3 sum = -h.moment;
    for (int s = 0; s < 2; ++s) sum += h.turn[s].transpose() * c_[h.ends[s].fan].col(h.ends[s].edge);
    return sum;
  }

  // Makes a dihedral edge meet its conditions. Returns their squared error before.
  double meet(size_t number) {
    const Conditions& h = edges_[number];
    const Vec3 by = error(h), factors = h.inverse * by;
    for (int s = 0; s < 2; ++s) {
      const auto& [fan, i] = h.ends[s];
      FanMatrix& c = c_[fan];
      if (proportional_) {
        const Row own = scaled_[fan].metric.col(i), change = weighted_[number][s] * factors / 2;
        c -= change * own.transpose() + own * change.transpose();
        continue;
      }
      const Row change = h.turn[s] * factors / 2;
      c.col(i) -= change;
      c.row(i) -= change.transpose();
    }
    return by.squaredNorm();
  }

  const std::vector<SheetTriangle>& sheet_;
  const std::vector<DihedralFan>& fans_;
  const VecX& rest_;
  bool proportional_;
  Mat3 material_;  // moments of curvatures: M_xx, 2 M_xy, M_yy
  std::vector<ScaledFan> scaled_;
  std::vector<FanMatrix> c_;
  std::vector<Conditions> edges_;
  std::vector<std::array<Rows, 2>> weighted_;  // how far curvatures turn them, in the metric of their fans; if proportional
};

}  // namespace

FittedFans fit_dihedral_stiffness(const std::vector<SheetTriangle>& sheet, const VecX& rest, double stiffness, double poisson) {
  FittedFans out{dihedral_fans(sheet, few_edges), {}, 0};
  if (out.fans.empty()) return out;
  const auto take = [&](const Fit& fit) {
    out.c = fit.matrices(stiffness);
    out.error = fit.error();
  };
  Fit fit(sheet, out.fans, rest, poisson, false);
  fit.solve(first_sweeps);
  if (fit.error() <= hopeful) fit.solve(most_sweeps - first_sweeps);
  if (fit.error() <= enough) {
    take(fit);
    return out;
  }
  out.fans = dihedral_fans(sheet, fan_edges_max);
  Fit again(sheet, out.fans, rest, poisson, true);
  again.solve(most_sweeps);
  take(again);
  return out;
}

}  // namespace tack
