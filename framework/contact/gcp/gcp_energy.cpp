#include "framework/contact/gcp/gcp_energy.hpp"

#include <Eigen/Geometry>

#include "framework/contact/gcp/directional_cosine.hpp"
#include "framework/contact/gcp/smooth_steps.hpp"
#include "geometry/distance/point_edge.hpp"

namespace tack {
namespace {

using CoreDerivatives = StencilDerivatives<12>;

template <class Kernels>
auto squared_distance_of(GcpKind kind, const GcpPositions& x) {
  switch (kind) {
    case GcpKind::vertex_vertex: return embed<4, 0, 1>(Kernels::point_point(x[0], x[1]));
    case GcpKind::vertex_edge: return embed<4, 0, 1, 2>(Kernels::point_line(x[0], x[1], x[2]));
    case GcpKind::vertex_face: return Kernels::point_plane(x[0], x[1], x[2], x[3]);
    case GcpKind::edge_edge: break;
  }
  return Kernels::line_line(x[0], x[1], x[2], x[3]);
}

// Calls body(squared distance from the closest points to a part of the boundary, plus delta^2) for each
// part of the boundaries.
template <class Kernels, class Body>
void for_each_boundary(GcpKind kind, const GcpPositions& x, const Body& body) {
  const auto point_edge = [&](int p, int a, int b) {
    return reduce_point_edge<Kernels>(x[p], x[a], x[b], point_edge_type(x[p], x[a], x[b]));
  };
  switch (kind) {
    case GcpKind::vertex_vertex: return;
    case GcpKind::vertex_edge:
      body(embed<4, 0, 1>(Kernels::point_point(x[0], x[1])));
      body(embed<4, 0, 2>(Kernels::point_point(x[0], x[2])));
      return;
    case GcpKind::vertex_face:
      body(embed<4, 0, 1, 2>(Kernels::point_line(x[0], x[1], x[2])));
      body(embed<4, 0, 2, 3>(Kernels::point_line(x[0], x[2], x[3])));
      body(embed<4, 0, 3, 1>(Kernels::point_line(x[0], x[3], x[1])));
      return;
    case GcpKind::edge_edge:
      body(embed<4, 0, 2, 3>(point_edge(0, 2, 3)));
      body(embed<4, 1, 2, 3>(point_edge(1, 2, 3)));
      body(embed<4, 2, 0, 1>(point_edge(2, 0, 1)));
      body(embed<4, 3, 0, 1>(point_edge(3, 0, 1)));
  }
}

// Returns the direction from a primitive to the other one relative to U: 1 or -1.
double sign_towards_other(GcpKind kind, int primitive, const GcpPositions& x) {
  double to_first = 1;
  if (kind == GcpKind::vertex_face) to_first = (x[2] - x[1]).cross(x[3] - x[1]).dot(x[0] - x[1]);
  if (kind == GcpKind::edge_edge) to_first = (x[1] - x[0]).cross(x[3] - x[2]).dot(x[0] - x[2]);
  return (to_first < 0) == (primitive == 0) ? 1 : -1;
}

// Returns the sign of U in the cosine of a factor: of u, and of -u for tangents.
double factor_sign(GcpKind kind, const GcpFactor& f, const GcpPositions& x) {
  const double towards = sign_towards_other(kind, f.primitive, x);
  return f.type == GcpFactor::Type::tangent ? -towards : towards;
}

SmoothStep step_of(const GcpFactor& f, const GcpSmoothing& s, double cosine) {
  return f.type == GcpFactor::Type::tangent ? smooth_heaviside(cosine, s.alpha_t, s.beta_t)
                                            : smooth_heaviside(cosine, s.alpha_n, s.beta_n);
}

// Last factor, exclusive, of the exterior factors of one primitive that begin at `first`.
size_t exterior_end(std::span<const GcpFactor> factors, size_t first) {
  size_t end = first;
  while (end < factors.size() && factors[end].type == GcpFactor::Type::exterior &&
         factors[end].primitive == factors[first].primitive)
    ++end;
  return end;
}

// Sum of derivatives over the vertices of a stencil.
struct Sums {
  GcpGradient& gradient;
  GcpHessian* hessian;

  void add_core(int core, double f1, double f2, const CoreDerivatives& y) {
    const int n = 3 * core;
    gradient.head(n) += f1 * y.gradient.head(n);
    if (hessian)
      hessian->topLeftCorner(n, n) += f1 * y.hessian.topLeftCorner(n, n) + f2 * y.gradient.head(n) * y.gradient.head(n).transpose();
  }
  template <size_t M, int N, bool Curvature>
  void add(const std::array<Difference, M>& at, const DualMany<N, Curvature>& y) {
    for (size_t k = 0; k < M; ++k) {
      const Eigen::Map<const Vec3> part(y.d.data() + 3 * k);
      gradient.segment<3>(3 * at[k].plus) += part;
      gradient.segment<3>(3 * at[k].minus) -= part;
    }
    if constexpr (Curvature) {
      const auto entry = [&](int i, int j) { return i >= j ? y.h[i * (i + 1) / 2 + j] : y.h[j * (j + 1) / 2 + i]; };
      for (size_t k = 0; k < M; ++k)
        for (size_t l = 0; l < M; ++l) {
          Mat3 block;
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) block(i, j) = entry(static_cast<int>(3 * k) + i, static_cast<int>(3 * l) + j);
          hessian->block<3, 3>(3 * at[k].plus, 3 * at[l].plus) += block;
          hessian->block<3, 3>(3 * at[k].plus, 3 * at[l].minus) -= block;
          hessian->block<3, 3>(3 * at[k].minus, 3 * at[l].plus) -= block;
          hessian->block<3, 3>(3 * at[k].minus, 3 * at[l].minus) += block;
        }
    }
  }
};

template <class Cosine, class T>
std::array<Vector3<T>, Cosine::count> variables_of(const std::array<Difference, Cosine::count>& at, const GcpPositions& x) {
  std::array<Vector3<T>, Cosine::count> v;
  for (int k = 0; k < Cosine::count; ++k)
    for (int i = 0; i < 3; ++i) {
      const double value = x[at[k].plus][i] - x[at[k].minus][i];
      if constexpr (std::is_same_v<T, double>) v[k][i] = value;
      else v[k][i] = T::variable(value, 3 * k + i);
    }
  return v;
}

// Adds ln H of a tangent factor (logarithm), or H of an exterior factor.
template <bool Curvature>
void add_factor(GcpKind kind, const GcpFactor& f, const GcpSmoothing& smoothing, const GcpPositions& x, bool logarithm, Sums& sums) {
  const double sign = factor_sign(kind, f, x);
  with_cosine(kind, f, [&](auto cosine) {
    using Cosine = decltype(cosine);
    using T = DualMany<Cosine::variables, Curvature>;
    const auto at = Cosine::differences(f);
    const auto v = variables_of<Cosine, T>(at, x);
    const T y = Cosine::cosine(f, v.data()) * sign;
    const SmoothStep h = step_of(f, smoothing, y.v);
    const double q = h.slope / h.value;
    sums.add(at, logarithm ? y.chain(0, q, h.curvature / h.value - q * q) : y.chain(h.value, h.slope, h.curvature));
  });
}

// Adds the derivatives of ln Gamma, Gamma > 0.
template <bool Curvature>
void add_log_direction(const GcpStencil& s, std::span<const GcpFactor> factors, const GcpSmoothing& smoothing,
                       const GcpPositions& x, const CoreDerivatives& squared, Sums& log) {
  const int core = gcp_core_count(s.kind);
  for_each_boundary<DerivativeKernels>(s.kind, x, [&](const CoreDerivatives& a) {
    // y = (A / B - 1) / c of the squared distances A and B.
    const double b = squared.value, c = smoothing.mollifier_width, y = (a.value / b - 1) / c;
    if (y >= 1 || y <= 0) return;
    const SmoothStep h = quadratic_step(y);
    CoreDerivatives ratio;
    const double r = a.value / b;
    ratio.gradient = (a.gradient - r * squared.gradient) / (b * c);
    ratio.hessian = (a.hessian - r * squared.hessian) / (b * c) -
                    (ratio.gradient * squared.gradient.transpose() + squared.gradient * ratio.gradient.transpose()) / b;
    const double q = h.slope / h.value;
    log.add_core(core, q, h.curvature / h.value - q * q, ratio);
  });
  for (size_t i = 0; i < factors.size();) {
    if (factors[i].type == GcpFactor::Type::tangent) {
      add_factor<Curvature>(s.kind, factors[i], smoothing, x, true, log);
      ++i;
      continue;
    }
    // ln H(sum_f H_f - 1; 1, 0).
    const size_t end = exterior_end(factors, i);
    const int n = 3 * s.arity;
    GcpGradient sum_gradient = GcpGradient::Zero(n);
    GcpHessian sum_hessian;
    if (Curvature) sum_hessian = GcpHessian::Zero(n, n);
    Sums sums{sum_gradient, Curvature ? &sum_hessian : nullptr};
    double sum = 0;
    for (; i < end; ++i) {
      sum += step_of(factors[i], smoothing, gcp_cosine(s.kind, factors[i], x)).value;
      add_factor<Curvature>(s.kind, factors[i], smoothing, x, false, sums);
    }
    const SmoothStep h = smooth_heaviside(sum - 1, 1, 0);
    const double q = h.slope / h.value;
    log.gradient += q * sum_gradient;
    if (Curvature) *log.hessian += q * sum_hessian + (h.curvature / h.value - q * q) * sum_gradient * sum_gradient.transpose();
  }
}

}  // namespace

double gcp_distance(GcpKind kind, const GcpPositions& x) {
  const auto squared = [&]() -> double {
    switch (kind) {
      case GcpKind::vertex_vertex: return point_point_distance(x[0], x[1]);
      case GcpKind::vertex_edge: return point_line_distance(x[0], x[1], x[2]);
      case GcpKind::vertex_face: return point_plane_distance(x[0], x[1], x[2], x[3]);
      case GcpKind::edge_edge: break;
    }
    return line_line_distance(x[0], x[1], x[2], x[3]);
  };
  return std::sqrt(squared());
}

double gcp_cosine(GcpKind kind, const GcpFactor& f, const GcpPositions& x) {
  return factor_sign(kind, f, x) * with_cosine(kind, f, [&](auto cosine) {
           using Cosine = decltype(cosine);
           const auto v = variables_of<Cosine, double>(Cosine::differences(f), x);
           return Cosine::cosine(f, v.data());
         });
}

double gcp_mollifier(GcpKind kind, const GcpSmoothing& smoothing, const GcpPositions& x) {
  const double delta = gcp_distance(kind, x);
  double product = 1;
  for_each_boundary<ValueKernels>(kind, x, [&](double a) {
    product *= quadratic_step((a / (delta * delta) - 1) / smoothing.mollifier_width).value;
  });
  return product;
}

double gcp_direction(const GcpStencil& s, std::span<const GcpFactor> factors, const GcpSmoothing& smoothing, const GcpPositions& x) {
  double product = gcp_mollifier(s.kind, smoothing, x);
  for (size_t i = 0; i < factors.size();) {
    if (factors[i].type == GcpFactor::Type::tangent) {
      product *= step_of(factors[i], smoothing, gcp_cosine(s.kind, factors[i], x)).value;
      ++i;
      continue;
    }
    double sum = 0;
    for (const size_t end = exterior_end(factors, i); i < end; ++i)
      sum += step_of(factors[i], smoothing, gcp_cosine(s.kind, factors[i], x)).value;
    product *= smooth_heaviside(sum - 1, 1, 0).value;
  }
  return product;
}

void gcp_derivatives(const GcpStencil& s, std::span<const GcpFactor> factors, const GcpSmoothing& smoothing, const GcpPositions& x,
                     const LawSample& law, GcpGradient& gradient, GcpHessian* hessian) {
  const int n = 3 * s.arity, core = 3 * gcp_core_count(s.kind);
  const CoreDerivatives squared = squared_distance_of<DerivativeKernels>(s.kind, x);
  gradient.setZero(n);
  if (hessian) hessian->setZero(n, n);
  const double gamma = gcp_direction(s, factors, smoothing, x);
  if (!(gamma > 0)) return;  // its derivatives vanish as well, and its logarithm does not exist
  Sums log{gradient, hessian};
  if (hessian) add_log_direction<true>(s, factors, smoothing, x, squared, log);
  else add_log_direction<false>(s, factors, smoothing, x, squared, log);
  const double delta = std::sqrt(squared.value), factor = s.weight * gamma;
  const Vec12 d_delta = squared.gradient / (2 * delta);
  if (hessian) {
    const Eigen::Matrix<double, 12, 12> d2_delta = squared.hessian / (2 * delta) - d_delta * d_delta.transpose() / delta;
    GcpHessian& h = *hessian;
    h += gradient * gradient.transpose();
    h *= law.value;
    h.leftCols(core) += law.slope * gradient * d_delta.head(core).transpose();
    h.topRows(core) += law.slope * d_delta.head(core) * gradient.transpose();
    h.topLeftCorner(core, core) += law.slope * d2_delta.topLeftCorner(core, core) +
                                   law.curvature * d_delta.head(core) * d_delta.head(core).transpose();
    h *= factor;
  }
  gradient *= law.value;
  gradient.head(core) += law.slope * d_delta.head(core);
  gradient *= factor;
}

}  // namespace tack
