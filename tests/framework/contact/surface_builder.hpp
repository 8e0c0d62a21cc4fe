// Contact surfaces made vertex by vertex, without a world, for tests of geometry alone.
#pragma once

#include <Eigen/Geometry>
#include <random>

#include "framework/contact/surface/lagged_surface.hpp"
#include "tests/geometry/broad_phase/scenes.hpp"

namespace tack {

struct SurfaceBuilder {
  scenes::Scene scene;
  std::vector<char> two_sided;                     // per triangle
  std::vector<double> rod_width, particle_radius;  // per object [m]

  int add_vertex(const Vec3& position, int object) {
    const size_t objects = static_cast<size_t>(object) + 1;
    if (rod_width.size() < objects) rod_width.resize(objects, 0);
    if (particle_radius.size() < objects) particle_radius.resize(objects, 0);
    return scene.add_vertex(position, object);
  }
  // Returns the index of the triangle.
  int add_triangle(const Triangle& t, bool sheet = false) {
    scene.add_triangle(t);
    two_sided.push_back(sheet);
    return static_cast<int>(two_sided.size()) - 1;
  }
  int add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, int object, bool sheet = false) {
    const int first = add_vertex(a, object);
    add_vertex(b, object);
    add_vertex(c, object);
    return add_triangle({first, first + 1, first + 2}, sheet);
  }
  // Adds a grid of cells from position(0, 0) to position(1, 1); its normals are the cross products
  // of the directions of u and v. Returns the index of the first triangle.
  int add_grid(std::array<int, 2> cells, int object,
               const std::function<Vec3(double, double)>& position, bool sheet = false) {
    const int first = static_cast<int>(scene.mesh.vertex_object.size());
    const int row = cells[0] + 1, begin = static_cast<int>(two_sided.size());
    for (int j = 0; j <= cells[1]; ++j)
      for (int i = 0; i <= cells[0]; ++i)
        add_vertex(position(i / double(cells[0]), j / double(cells[1])), object);
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i) {
        const int a = first + j * row + i, b = a + 1, c = b + row, d = a + row;
        add_triangle({a, b, (i + j) % 2 ? d : c}, sheet);
        add_triangle({(i + j) % 2 ? b : a, c, d}, sheet);
      }
    return begin;
  }
  // Adds a rectangle in a plane of constant z, with its normal along z, or against z.
  int add_rectangle(std::array<int, 2> cells, int object, const Vec3& corner, double width,
                    double depth, bool up = true, bool sheet = false) {
    return add_grid(
        up ? cells : std::array{cells[1], cells[0]}, object,
        [=](double u, double v) {
          return Vec3(corner +
                      (up ? Vec3(width * u, depth * v, 0) : Vec3(width * v, depth * u, 0)));
        },
        sheet);
  }
  // Adds the six faces of a box with outward normals, two triangles each.
  void add_box(const Vec3& lo, const Vec3& hi, int object) {
    const int first = static_cast<int>(scene.mesh.vertex_object.size());
    for (int i = 0; i < 8; ++i)
      add_vertex({i & 1 ? hi.x() : lo.x(), i & 2 ? hi.y() : lo.y(), i & 4 ? hi.z() : lo.z()},
                 object);
    for (const auto& [a, b, c, d] : {std::array{0, 2, 3, 1},
                                     {4, 5, 7, 6},
                                     {0, 1, 5, 4},
                                     {2, 6, 7, 3},
                                     {0, 4, 6, 2},
                                     {1, 3, 7, 5}}) {
      add_triangle({first + a, first + b, first + c});
      add_triangle({first + a, first + c, first + d});
    }
  }
  // Adds a rod through these points. Returns the index of its first vertex.
  int add_rod(const std::vector<Vec3>& points, int object, double width) {
    const int first = add_vertex(points[0], object);
    rod_width[object] = width;
    for (size_t i = 1; i < points.size(); ++i) {
      const int last = add_vertex(points[i], object);
      scene.add_rod_edge(last - 1, last);
    }
    return first;
  }
  int add_particle(const Vec3& position, int object, double radius) {
    const int v = add_vertex(position, object);
    scene.mesh.codim_points.push_back(v);
    particle_radius[object] = radius;
    return v;
  }

  VecX x() const { return scene.x(); }
  ContactSurface surface() const {
    ContactSurface s;
    s.mesh = scene.mesh;
    s.edge_area.assign(s.mesh.edges.size(), 1);
    s.two_sided = two_sided;
    s.rod_width = rod_width;
    s.particle_radius = particle_radius;
    s.rest = x();
    return s;
  }
};

// A contact surface, and its lagged surface at given positions.
struct SurfaceAt {
  SurfaceAt(const SurfaceBuilder& builder, const VecX& x) : surface(builder.surface()) {
    lagged.update(x);
  }
  explicit SurfaceAt(const SurfaceBuilder& builder) : SurfaceAt(builder, builder.x()) {}
  SurfaceAt(const SurfaceAt&) = delete;
  SurfaceAt& operator=(const SurfaceAt&) = delete;

  const ContactSurface surface;
  LaggedSurface lagged{surface};
};

// Random points, directions and rotations; a seed gives one sequence.
class RandomPoints {
 public:
  explicit RandomPoints(unsigned seed) : generator_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  int index(int count) { return std::uniform_int_distribution<int>(0, count - 1)(generator_); }
  Vec3 point(double size) { return scenes::random_point(generator_, size); }
  Vec3 direction() {
    Vec3 p = point(1);
    while (p.norm() < 0.1 || p.norm() > 1) p = point(1);
    return p.normalized();
  }
  Mat3 rotation() {
    return Eigen::AngleAxisd(uniform(-M_PI, M_PI), direction()).toRotationMatrix();
  }
  // Barycentric coordinates of a point inside a triangle, uniform over its area.
  Vec3 inside() {
    const double r = std::sqrt(uniform(0, 1)), u = uniform(0, 1);
    return {1 - r, r * (1 - u), r * u};
  }

 private:
  std::mt19937 generator_;
};

inline VecX moved(const VecX& x, const Mat3& rotation, const Vec3& offset) {
  VecX y(x.size());
  for (int v = 0; v < x.size() / 3; ++v) vertex(y, v) = rotation * vertex(x, v) + offset;
  return y;
}

}  // namespace tack
