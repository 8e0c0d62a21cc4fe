// The clipped integral against closed forms, with the area integral beside it: plates, cubes, tilted
// plates, spheres, bars, corners and edges. `tack_tests "[clipped_table]"` prints all figures.
#include <catch2/catch.hpp>

#include "tests/framework/contact/clipped/battery.hpp"

using namespace tack;
using namespace tack::battery;

namespace {

constexpr double degree = M_PI / 180;
const double gaps[] = {0.1, 0.3, 0.5001, 0.7, 0.9};

std::string plate(double width, double depth, int cells) { return box({width, 1, depth}, {cells, 1, cells}); }
// The lower side of a plate of thickness 1 at a gap; the upper side at zero.
Vec3 above(double gap) { return {0, gap + 0.5, 0}; }
const Vec3 below{0, -0.5, 0};

Ratios full_overlap(const std::string& integral, double lower_width) {
  Ratios all;
  Bodies bodies(integral, plate(10, 10, 8), plate(lower_width, lower_width, 7));
  for (const double gap : gaps)
    for (const double irregularity : {0.0, 0.25})
      all.add(bodies.at(irregular(10, 10, 8, irregularity, shifted(above(gap))),
                        irregular(lower_width, lower_width, 7, irregularity, shifted(below))),
              even(100, gap), {0, 0}, 10 * range * law_at(gap).value);
  return all;
}

// The upper plate lies over the lower one from a shift to the end of the lower one.
Ratios partial_overlap(const std::string& integral, int upper_cells, int lower_cells, double irregularity, double lower_depth) {
  Ratios all;
  constexpr double gap = 0.3;
  Bodies bodies(integral, plate(10, 10, upper_cells), plate(10, lower_depth, lower_cells));
  for (const double shift : {1.01, 2.0, 3.3, 5.0, 6.6, 7.9, 9.0}) {
    const double pull = 10 * range * law_at(gap).value;
    all.add(bodies.at(irregular(10, 10, upper_cells, irregularity, shifted(above(gap) + Vec3(shift, 0, 0))),
                      irregular(10, lower_depth, lower_cells, irregularity, shifted(below))),
            even(10 * (10 - shift), gap), {pull, 0}, pull);
  }
  return all;
}

Ratios cube_on_ground(const std::string& integral, double cell) {
  Ratios all;
  constexpr double gap = 0.3;
  const int cells = static_cast<int>(std::lround(40 / cell));
  Bodies bodies(integral, box({10, 10, 10}, {4, 4, 4}), box({40, 1, 40}, {cells, 1, cells}));
  RandomMotions random(7);
  const int placements = cell < 2 || integral == "area_integral" ? 8 : 48;
  for (int k = 0; k < placements; ++k) {
    const double angle = k % 3 == 0 ? 0 : 90 * degree * random.uniform(0, 1);
    const Vec3 shift(cell * random.uniform(0, 1), gap + 5, cell * random.uniform(0, 1));
    all.add(bodies.at(turned(angle, Vec3::UnitY(), shift), shifted(below)), even(100, gap), {0, 0}, 10 * range * law_at(gap).value);
  }
  return all;
}

// A sheet, tilted about an edge at a gap of 0.1. (The side walls of a plate would face down, too.)
Ratios tilted_plate(const std::string& integral, double angle, int cells) {
  Ratios all;
  constexpr double low = 0.1;
  Bodies bodies(integral, grid(10, 10, cells, cells), plate(20, 16, cells));
  const Exact exact = integrate(10 * std::cos(angle), [&](double s) { return low + std::tan(angle) * s; }, [](double) { return 10.0; });
  const Mat3 rotation = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  for (const double shift : {0.0, 0.37, 1.1}) {
    const Placement tilted = [&](const Vec3& p) { return Vec3(rotation * (p + Vec3(5, 0, 0)) + Vec3(-5 - shift, low, 0)); };
    all.add(bodies.at(irregular(10, 10, cells, cells > 2 ? 0.2 : 0, tilted), shifted(below)), exact, {0, 0}, 10 * range * law_at(0).value);
  }
  return all;
}

// A cap of a sphere of 10 ranges, of cells of equal size seen from below, above a plane.
Ratios sphere_on_plane(const std::string& integral, int cells) {
  Ratios all;
  constexpr double radius = 10, low = 0.1, width = 12;
  Bodies bodies(integral, grid(width, width, cells, cells), plate(20, 20, 8));
  // Gaps are below the range within 4.4 of the axis.
  const Exact exact = integrate(width / 2, [&](double s) { return low + radius - std::sqrt(radius * radius - s * s); },
                                [](double s) { return 2 * M_PI * s; });
  for (const Vec2& shift : {Vec2(0, 0), Vec2(0.3, 0.2), Vec2(0.6, 0.7)})
    all.add(bodies.at([&](const Vec3& p) { return Vec3(p.x() + shift.x(), low + radius - std::sqrt(radius * radius - p.x() * p.x() - p.z() * p.z()), p.z() + shift.y()); },
                      shifted(below)), exact, {0, 0}, exact.normal);
  return all;
}

// Concentric caps of 10 and 10.3 ranges. The energy counts per area of the socket, whose planes are
// used: (10.3 / 10)^2 of the ball's.
Ratios ball_in_socket(const std::string& integral, int cells) {
  const auto cap = [](double radius) {
    return [radius](const Vec3& p) { return Vec3(p.x(), -std::sqrt(radius * radius - p.x() * p.x() - p.z() * p.z()), p.z()); };
  };
  Bodies bodies(integral, grid(8, 8, cells, cells), grid(13, 13, cells + 3, cells + 3));
  Exact exact{0, 0};
  constexpr int points = 400;
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j) {
      const double x = 8 * ((i + 0.5) / points - 0.5), z = 8 * ((j + 0.5) / points - 0.5), height = std::sqrt(100 - x * x - z * z);
      const Exact one = even(64.0 / (points * points) * 1.03 * 1.03, 0.3);
      exact.energy += one.energy * 10 / height;  // area of the ball over that seen from above
      exact.normal += one.normal;
    }
  Ratios all;
  all.add(bodies.at(cap(10), cap(10.3)), exact, {0, 0}, exact.normal);
  return all;
}

Ratios crossed_bars(const std::string& integral, double angle, double cell) {
  Ratios all;
  constexpr double gap = 0.3, width = 1.5;
  const int cells = static_cast<int>(std::lround(40 / cell));
  Bodies bodies(integral, box({40, width, width}, {cells, 1, 1}), box({40, width, width}, {cells, 1, 1}));
  // Along the upper bar, and along the lower one, whose planes are used.
  for (const double shift : {0.0, 0.4, 1.3})
    for (const double along : {0.0, 0.2, 0.5, 0.75, 0.9, 1.4, 2.6, 5.0, 7.3})
      all.add(bodies.at(turned(angle, Vec3::UnitY(), Vec3(along + shift * std::cos(angle), gap + width / 2, -shift * std::sin(angle))), shifted({0, -width / 2, 0})),
              even(width * width / std::sin(angle), gap), {0, 0}, width * range * law_at(gap).value);
  return all;
}

Ratios corner_down(const std::string& integral, int cells) {
  Ratios all;
  Bodies bodies(integral, box({10, 10, 10}, {cells, cells, cells}), plate(30, 30, 6));
  const Mat3 upright = Eigen::Quaterniond::FromTwoVectors(Vec3(1, 1, 1), Vec3(0, 1, 0)).toRotationMatrix();
  for (const double low : {0.05, 0.3, 0.6}) {
    // The cross-section at a height h is 3/2 sqrt(3) h^2.
    const Exact exact = integrate(1, [&](double s) { return low + s; }, [](double s) { return 3 * std::sqrt(3.0) * s; });
    all.add(bodies.at([&](const Vec3& p) { return Vec3(upright * (p + Vec3(5, 5, 5)) + Vec3(0.13, low, 0.21)); }, shifted(below)),
            exact, {0, 0}, exact.normal);
  }
  return all;
}

Ratios edge_on_face(const std::string& integral, int cells) {
  Ratios all;
  Bodies bodies(integral, box({10, 10, 10}, {cells, cells, cells}), plate(30, 30, 6));
  const Mat3 upright = Eigen::AngleAxisd(45 * degree, Vec3::UnitZ()).toRotationMatrix();
  for (const double low : {0.05, 0.3, 0.6}) {
    const Exact exact = integrate(1, [&](double s) { return low + s; }, [](double) { return 20.0; });
    all.add(bodies.at([&](const Vec3& p) { return Vec3(upright * (p + Vec3(5, 5, 0)) + Vec3(0.17, low, 0.1)); }, shifted(below)),
            exact, {0, 0}, exact.normal);
  }
  return all;
}

std::vector<Row> rows() {
  // Bounds are two to three times the measured errors, and 1e-6 where these are round-off. Area integral:
  // no bound where its figure depends on where vertices happen to be.
  constexpr ErrorBounds exact{1e-6, 1e-6, 1e-6};
  std::vector<Row> all;
  const auto add = [&](std::string name, auto measure, ErrorBounds clipped, ErrorBounds lagged) { all.push_back({std::move(name), measure, clipped, lagged}); };
  add("full overlap, wider below", [](auto& i) { return full_overlap(i, 14); }, exact, exact);
  add("full overlap, equal plates", [](auto& i) { return full_overlap(i, 10); }, exact, exact);
  for (const double depth : {16.0, 10.0}) {
    const std::string width = depth > 10 ? "" : ", equal width";
    const ErrorBounds strip{5e-5, 5e-5, 2e-3};
    add("partial overlap, 8/7 cells" + width, [=](auto& i) { return partial_overlap(i, 8, 7, 0, depth); }, strip, exact);
    add("partial overlap, 20/7 cells" + width, [=](auto& i) { return partial_overlap(i, 20, 7, 0, depth); }, strip, exact);
    add("partial overlap, 8/7 irregular" + width, [=](auto& i) { return partial_overlap(i, 8, 7, 0.3, depth); }, strip, exact);
    add("partial overlap, 2/1 cells" + width, [=](auto& i) { return partial_overlap(i, 2, 1, 0, depth); }, exact, exact);
  }
  for (const double cell : {10.0, 5.0, 2.5, 1.25})
    add(fmt::format("cube of 10 on cells of {}", cell), [=](auto& i) { return cube_on_ground(i, cell); }, exact, exact);
  for (const int cells : {8, 2})
    for (const double angle : {1.0, 3.0, 5.0, 10.0})
      add(fmt::format("tilted by {} degrees, {} cells", angle, cells), [=](auto& i) { return tilted_plate(i, angle * degree, cells); }, exact, {6e-3, 0.04, 1e-6});
  // The chords of the sphere lie above it.
  for (const auto& [cells, error] : {std::pair{4, 0.12}, {8, 0.03}, {16, 0.007}, {32, 0.002}})
    add(fmt::format("sphere of 10, cells of {:.2f}", 12.0 / cells), [=, cells = cells](auto& i) { return sphere_on_plane(i, cells); }, {0, error, 1e-6}, {0, error, 0});
  for (const int cells : {6, 12})
    add(fmt::format("ball in socket, cells of {:.2f}", 8.0 / cells), [=](auto& i) { return ball_in_socket(i, cells); }, {0.02, 0, 1e-6}, {});
  // Bars are so narrow that strips lack the corners of their triangles (strip_edges.hpp).
  for (const double angle : {90.0, 80.0, 30.0})
    for (const double cell : {10.0, 2.0})
      add(fmt::format("bars at {} degrees, cells of {}", angle, cell), [=](auto& i) { return crossed_bars(i, angle * degree, cell); },
          {cell > 2 ? 5e-4 : 2e-3, cell > 2 ? 5e-4 : 2e-3, cell > 2 ? 0.015 : 0.1}, exact);
  for (const int cells : {2, 8}) {
    add(fmt::format("corner down, {} cells", cells), [=](auto& i) { return corner_down(i, cells); }, exact, {});
    add(fmt::format("edge on face, {} cells", cells), [=](auto& i) { return edge_on_face(i, cells); }, exact, {});
  }
  return all;
}

}  // namespace

TEST_CASE("clipped battery: table", "[.][clipped_table]") { print_table(rows()); }

TEST_CASE("clipped battery: plates, cubes, tilts, spheres, bars, corners and edges", "[clipped]") { check(rows()); }
