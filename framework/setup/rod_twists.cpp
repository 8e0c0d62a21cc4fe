#include "framework/setup/rod_twists.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include "framework/body/selected_elements.hpp"
#include "framework/rod/rod_frames.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

Vec3 span(const Edge& e, const VecX& x) { return vertex(x, e[1]) - vertex(x, e[0]); }

// Rotates a vector by the smallest rotation that takes `from` to `to`. (Eigen's FromTwoVectors
// contains a singular value decomposition for opposite vectors, which costs ten seconds of compile
// time.)
Vec3 parallel_transport(const Vec3& from, const Vec3& to, const Vec3& vector) {
  const Vec3 a = from.normalized(), b = to.normalized(), axis = a.cross(b);
  const double squared = 2 * (1 + a.dot(b));  // (2 cos(angle / 2))^2
  if (squared < 1e-12) {
    const Vec3 across = a.unitOrthogonal();  // half a turn, about any axis
    return 2 * across.dot(vector) * across - vector;
  }
  const double s = std::sqrt(squared);
  return Quaternion(s / 2, axis.x() / s, axis.y() / s, axis.z() / s) * vector;
}

// Returns the directors of a circular section, transported from edge to edge by smallest rotations,
// so that the frames of an open rod do not twist.
std::vector<Vec3> transported_directors(const std::vector<Edge>& edges, const VecX& rest) {
  std::map<int, std::vector<int>> around;
  for (size_t e = 0; e < edges.size(); ++e)
    for (const int v : edges[e]) around[v].push_back(static_cast<int>(e));
  std::vector<Vec3> directors(edges.size(), Vec3::Zero());
  for (size_t root = 0; root < edges.size(); ++root) {
    if (!directors[root].isZero()) continue;
    directors[root] = span(edges[root], rest).unitOrthogonal();
    for (std::vector<int> open = {static_cast<int>(root)}; !open.empty();) {
      const int e = open.back();
      open.pop_back();
      for (const int v : edges[e])
        for (const int next : around[v]) {
          if (!directors[next].isZero()) continue;
          // Follows the path through v, whatever the orientation of its edges.
          const double same = edges[e][1] == v ? 1 : -1, onwards = edges[next][0] == v ? 1 : -1;
          directors[next] = parallel_transport(same * span(edges[e], rest), onwards * span(edges[next], rest), directors[e]);
          open.push_back(next);
        }
    }
  }
  return directors;
}

std::vector<Vec3> directors_of(const Body& body, const std::vector<Edge>& edges, const VecX& rest) {
  if (body.section->circular()) return transported_directors(edges, rest);
  constexpr double parallel = 1e-6;
  for (const Edge& e : edges)
    if (body.section->normal.cross(span(e, rest).normalized()).norm() < parallel)
      throw InputError(fmt::format("object '{}': its edge from vertex {} to {} lies along rod.normal, which has to point across every edge; "
                                   "choose another one", body.name, e[0] - body.first_vertex, e[1] - body.first_vertex));
  return std::vector<Vec3>(edges.size(), body.section->normal);
}

// Returns the edges that some energy twists, in the body's order.
std::vector<Edge> twisted_edges(const ObjectConfig& object, const Body& body, const VecX& rest) {
  std::set<Edge> twisted;
  for (const auto& energy : object.energies) {
    if (!energy->twists()) continue;
    const std::vector<Edge>& edges = energy->selection() ? selected_elements(*energy->selection(), {body, rest}).edges : body.edges;
    twisted.insert(edges.begin(), edges.end());
  }
  std::vector<Edge> edges;
  std::copy_if(body.edges.begin(), body.edges.end(), std::back_inserter(edges), [&](const Edge& e) { return twisted.count(e) > 0; });
  return edges;
}

// Prescribed twist of edges that another motion moves: the edge's frame at the start of a step
// rotates with the motion around the edge. For deforming motions, the linear part at the edge
// transforms the first director.
class PrescribedTwist : public Motion {
 public:
  PrescribedTwist(const Motion& motion, const RodFrames& rod) : Motion(motion.from(), motion.until()), motion_(motion), rod_(rod) {}
  void set_positions(std::span<const int> vertices, const VecX& rest, const VecX& reference, double t, VecX& x) const override {
    for (const int v : vertices) x(3 * v) = motion_.moves() ? arc(v - rod_.twists()[0], rest, reference, t, x) : reference(3 * v);
  }
  bool moves() const override { return motion_.moves(); }
  bool rigid() const override { return false; }  // a twist is not a position

 private:
  double arc(int e, const VecX& rest, const VecX& reference, double t, const VecX& x) const {
    const VecX& start = rod_.start();
    const double t0 = rod_.start_time(), theta = rod_.angle(e, start);
    if (t == t0) return rod_.radius() * theta;
    const Mat3 back = linear_part(e, rest, reference, t0).inverse();
    const Vec3 tangent = rod_.tangent(e, start), director = rod_.director(e, start);
    // Counts whole turns in substeps: the angle between the moved director and the transported one.
    constexpr int substeps = 32;
    double angle_sum = 0;
    Eigen::Vector3d t_before = tangent, d_before = director;
    for (int i = 1; i <= substeps; ++i) {
      const Mat3 moved = linear_part(e, rest, reference, t0 + (t - t0) * i / substeps) * back;
      const Vec3 t_now = (moved * tangent).normalized(), d_now = moved * director;
      const Vec3 transported = parallel_transport(t_before, t_now, d_before);
      angle_sum += std::atan2(t_now.dot(transported.cross(d_now)), transported.dot(d_now));
      t_before = t_now;
      d_before = (d_now - d_now.dot(t_now) * t_now).normalized();
    }
    constexpr double turn = 2 * std::numbers::pi;
    const double angle = rod_.angle_to(e, x, linear_part(e, rest, reference, t) * (back * director));
    return rod_.radius() * (angle + turn * std::round((theta + angle_sum - angle) / turn));
  }

  // Returns the linear part of the motion at the edge from the reference position to time t, by three points
  // beside its first vertex.
  Mat3 linear_part(int e, const VecX& rest, const VecX& reference, double t) const {
    const Edge& edge = rod_.edge(e);
    const double length = span(edge, rest).norm();
    VecX from_rest(12), from_reference(12), to = VecX::Zero(12);
    for (int k = 0; k < 4; ++k) {
      const Vec3 beside = k > 0 ? Vec3(length * Vec3::Unit(k - 1)) : Vec3::Zero();
      vertex(from_rest, k) = vertex(rest, edge[0]) + beside;
      vertex(from_reference, k) = vertex(reference, edge[0]) + beside;
    }
    motion_.set_positions(std::array{0, 1, 2, 3}, from_rest, from_reference, t, to);
    Mat3 linear;
    for (int k = 0; k < 3; ++k) linear.col(k) = (vertex(to, k + 1) - vertex(to, 0)) / length;
    return linear;
  }

  const Motion& motion_;
  const RodFrames& rod_;
};

}  // namespace

void add_twists(const ObjectConfig& object, int index, World& world) {
  Body& body = world.bodies[index];
  if (!body.section) return;
  const std::vector<Edge> edges = twisted_edges(object, body, world.rest);
  if (edges.empty()) return;
  const std::vector<Vec3> directors = directors_of(body, edges, world.rest);
  const double radius = body.section->radius_of_gyration();
  ScalarDofs twists = Unknowns(world, body.name, index).add_scalar_dofs("twist", static_cast<int>(edges.size()), radius);
  body.rod = std::make_shared<RodFrames>(body.name + "/rod/frames", edges, std::move(twists.vertices), directors, radius, world.rest);
}

void prescribe_twists(const Motion& motion, const std::vector<int>& vertices, const std::string& name, int index, World& world) {
  const auto& rod = world.bodies[index].rod;
  if (!rod || motion.partial()) return;
  const auto prescribed = [&](int v) { return std::binary_search(vertices.begin(), vertices.end(), v); };
  std::vector<int> twists;
  for (int e = 0; e < rod->count(); ++e)
    if (prescribed(rod->edge(e)[0]) && prescribed(rod->edge(e)[1])) twists.push_back(rod->twists()[e]);
  if (twists.empty()) return;
  world.own_motions.push_back(std::make_unique<PrescribedTwist>(motion, *rod));
  world.prescribed_motion.add({world.own_motions.back().get(), std::move(twists), name + ", the twist of its edges"});
}

}  // namespace tack
