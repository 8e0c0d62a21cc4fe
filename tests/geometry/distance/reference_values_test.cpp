// Distances, derivatives, types and mollifiers against tests/data/distances.json: values of an
// independent implementation in double precision, and under "exact" of high-precision arithmetic.
//
// Tolerances, relative:
//   squared distance and gradient against exact: 4e-15, that is 18 eps (plus the rounding of
//   coordinates
//     of about 1, which shows where the exact distance is zero). For crossing edges the closest
//     points are conditioned like 1 / sin(angle), so the gradient gets eps / sin(angle) on top;
//   Hessian: the same against the exact norm; entry by entry against the independent
//     double-precision result, which itself loses eps / sin^2, 4e-15 + eps / sin^2 of the norm.
#include <catch2/catch.hpp>
#include <map>

#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/edge_edge_mollifier.hpp"
#include "geometry/distance/point_edge.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "tests/support/json.hpp"

using namespace tack;
using nlohmann::json;

namespace {

constexpr double kTight = 4e-15;
constexpr double kEps = 2.3e-16;

const json& reference(const std::string& kind) {
  static const json file = read_json(TACK_TEST_DATA "/distances.json");
  return file.at("distances").at(kind);
}

Vec3 point(const json& record, const char* name) {
  const json& v = record.at(name);
  return Vec3(v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
}

VecX numbers(const json& array) {
  const auto values = array.get<std::vector<double>>();
  return Eigen::Map<const VecX>(values.data(), values.size());
}

// The Hessians are symmetric, so row and column major agree.
template <int N>
void check(const json& record, const StencilDerivatives<N>& d, double sine) {
  const json& exact = record.at("exact");
  const double s = exact.at("d2");
  CHECK(std::abs(d.value - s) <= kTight * s + 1e-32);
  const VecX gradient = numbers(exact.at("grad"));
  CHECK((d.gradient - gradient).norm() <= (kTight + kEps / sine) * gradient.norm() + 1e-16);

  const double norm = exact.at("hess_frobenius");
  CHECK(std::abs(d.hessian.norm() - norm) <= (kTight + kEps / sine) * norm);
  const VecX hessian = numbers(record.at("hess"));
  const Eigen::Map<const Eigen::Matrix<double, N * N, 1>> ours(d.hessian.data());
  CHECK((ours - hessian).norm() <= (kTight + kEps / (sine * sine)) * norm);
  CHECK((d.hessian - d.hessian.transpose()).norm() <= kTight * norm);
}

// Where two types give the same distance the choice between them is a convention.
template <typename Type, typename Distance>
int count_other_type(Type ours, Type theirs, const Distance& distance) {
  if (ours == theirs) return 0;
  CHECK(distance(ours) == Approx(distance(theirs)).epsilon(1e-12));
  return 1;
}

const std::map<std::string, PointEdgeType> kPointEdge = {
    {"P_E0", PointEdgeType::P_E0}, {"P_E1", PointEdgeType::P_E1}, {"P_E", PointEdgeType::P_E}};
const std::map<std::string, PointTriangleType> kPointTriangle = {
    {"P_T0", PointTriangleType::P_T0}, {"P_T1", PointTriangleType::P_T1},
    {"P_T2", PointTriangleType::P_T2}, {"P_E0", PointTriangleType::P_E0},
    {"P_E1", PointTriangleType::P_E1}, {"P_E2", PointTriangleType::P_E2},
    {"P_T", PointTriangleType::P_T}};
const std::map<std::string, EdgeEdgeType> kEdgeEdge = {
    {"EA0_EB0", EdgeEdgeType::EA0_EB0}, {"EA0_EB1", EdgeEdgeType::EA0_EB1},
    {"EA1_EB0", EdgeEdgeType::EA1_EB0}, {"EA1_EB1", EdgeEdgeType::EA1_EB1},
    {"EA_EB0", EdgeEdgeType::EA_EB0},   {"EA_EB1", EdgeEdgeType::EA_EB1},
    {"EA0_EB", EdgeEdgeType::EA0_EB},   {"EA1_EB", EdgeEdgeType::EA1_EB},
    {"EA_EB", EdgeEdgeType::EA_EB}};

}  // namespace

TEST_CASE("point-point distances have their reference values", "[distance]") {
  for (const json& record : reference("point_point")) {
    check(record, point_point_derivatives(point(record, "p0"), point(record, "p1")), 1.0);
  }
}

TEST_CASE("point-edge distances have their reference values", "[distance]") {
  int other = 0;
  for (const json& record : reference("point_edge")) {
    INFO(record.at("p") << " " << record.at("e0") << " " << record.at("e1"));
    const Vec3 p = point(record, "p"), e0 = point(record, "e0"), e1 = point(record, "e1");
    const PointEdgeType type = kPointEdge.at(record.at("type"));
    check(record, point_edge_derivatives(p, e0, e1, type), 1.0);
    other += count_other_type(point_edge_type(p, e0, e1), type,
                              [&](PointEdgeType t) { return point_edge_distance(p, e0, e1, t); });
  }
  CHECK(other == 2);  // points exactly beside an end of the edge
}

TEST_CASE("point-triangle distances have their reference values", "[distance]") {
  int other = 0;
  for (const json& record : reference("point_triangle")) {
    INFO(record.at("p") << " " << record.at("t0") << " " << record.at("t1") << " "
                        << record.at("t2"));
    const Vec3 p = point(record, "p"), t0 = point(record, "t0");
    const Vec3 t1 = point(record, "t1"), t2 = point(record, "t2");
    const PointTriangleType type = kPointTriangle.at(record.at("type"));
    check(record, point_triangle_derivatives(p, t0, t1, t2, type), 1.0);
    other += count_other_type(point_triangle_type(p, t0, t1, t2), type, [&](PointTriangleType t) {
      return point_triangle_distance(p, t0, t1, t2, t);
    });
  }
  CHECK(other <= 1);  // a point exactly above an edge, decided by rounding
}

TEST_CASE("edge-edge distances have their reference values", "[distance]") {
  int other = 0;
  for (const json& record : reference("edge_edge")) {
    INFO(record.at("ea0") << " " << record.at("ea1") << " " << record.at("eb0") << " "
                          << record.at("eb1"));
    const Vec3 ea0 = point(record, "ea0"), ea1 = point(record, "ea1");
    const Vec3 eb0 = point(record, "eb0"), eb1 = point(record, "eb1");
    const EdgeEdgeType type = kEdgeEdge.at(record.at("type"));
    const double sine = std::sqrt(edge_edge_cross_squared(ea0, ea1, eb0, eb1)) /
                        ((ea1 - ea0).norm() * (eb1 - eb0).norm());
    check(record, edge_edge_derivatives(ea0, ea1, eb0, eb1, type),
          type == EdgeEdgeType::EA_EB ? sine : 1.0);
    other += count_other_type(edge_edge_type(ea0, ea1, eb0, eb1), type, [&](EdgeEdgeType t) {
      return edge_edge_distance(ea0, ea1, eb0, eb1, t);
    });
  }
  CHECK(other <= 2);  // crossing at an angle of 1e-8 or less, where the reference says parallel
}

TEST_CASE("mollifiers have their reference values", "[distance]") {
  for (const json& record : reference("edge_edge")) {
    const Vec3 ea0 = point(record, "ea0"), ea1 = point(record, "ea1");
    const Vec3 eb0 = point(record, "eb0"), eb1 = point(record, "eb1");
    const json& expected = record.at("mollifier");
    const double eps_x = edge_edge_mollifier_threshold(ea0, ea1, eb0, eb1);
    CHECK(eps_x == Approx(expected.at("eps_x").get<double>()).epsilon(1e-14));
    const auto d = edge_edge_mollifier_derivatives(ea0, ea1, eb0, eb1, eps_x);
    // The cross product of nearly parallel edges keeps eps |a| |b| of absolute error.
    const double scale = std::sqrt(eps_x * 1e3);
    const double m = expected.at("m"), c = expected.at("cross_squarednorm");
    const double error = 1e-15 * scale / std::max(std::sqrt(c), 1e-300);
    CHECK(std::abs(edge_edge_cross_squared(ea0, ea1, eb0, eb1) - c) <= (1e-14 + error) * c);
    CHECK(std::abs(d.value - m) <= (1e-14 + error) * m);
    const VecX gradient = numbers(expected.at("grad")), hessian = numbers(expected.at("hess"));
    CHECK((d.gradient - gradient).norm() <= (1e-13 + error) * gradient.norm());
    const Eigen::Map<const Eigen::Matrix<double, 144, 1>> ours(d.hessian.data());
    CHECK((ours - hessian).norm() <= (1e-13 + error) * hessian.norm());
  }
}
