#include "framework/checks/bent_solids.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "framework/body/extent.hpp"
#include "framework/scene/copied_lines.hpp"
#include "framework/world/world.hpp"
#include "geometry/mesh/thickness.hpp"
#include "geometry/tet_edges.hpp"

namespace tack {
namespace {

constexpr int enough_cells = 8;
constexpr double slender = 10;       // the diagonal over 2 V / A, which is the thickness of a plate and half that of a bar
constexpr double patch_width = 4;    // in units of 2 V / A
constexpr double least_strain = 1e-6;  // root of the mean square
constexpr double bends = 0.8;        // fraction of bending
constexpr const char* of_linear = "with 1, 2, 4, 8 cells across a bar bends by 0.22, 0.50, 0.79, 0.93 of what it should "
                                  "(0.04, 0.10, 0.29, 0.58 at a Poisson's ratio of 0.49)";
constexpr const char* of_patches = "with 1, 2, 4, 8 cells across a bar bends by 0.32, 0.61, 0.85, 0.95 of what it should";

const char* by_cells(const Body& body) { return body.elements == Elements::patches ? of_patches : of_linear; }

// Returns the thickness of the solid part of a body: triangles of its own have none.
double thickness_of(const Body& body, const VecX& rest) {
  Thickness thickness;
  for (size_t i = 0; i + body.sheet.size() < body.triangles.size(); ++i) thickness.add(corners(rest, body.triangles[i]));
  return thickness.thickness();
}

// From one side to the other: twice the edges from the innermost vertex to the surface, and one.
int cells_across(const Body& body) {
  std::unordered_map<int, int> depth;
  for (const Triangle& t : body.triangles)
    for (const int v : t) depth[v] = 0;
  const auto count = [&](int d) { return 2 * d + 1; };
  for (int d = 1; count(d) <= enough_cells + 1; ++d) {
    bool deeper = false;
    for (const Tet& t : body.tets)
      for (const int v : t) {
        if (depth.contains(v)) continue;
        const bool next = std::any_of(t.begin(), t.end(), [&](int w) {
          const auto found = depth.find(w);
          return found != depth.end() && found->second == d - 1;
        });
        if (next) depth[v] = d, deeper = true;
      }
    if (!deeper) return count(d - 1);
  }
  return enough_cells + 1;
}

// The nearest of points that are a distance apart, or more.
class SparsePoints {
 public:
  explicit SparsePoints(double apart) : apart_(apart) {}

  int nearest(const Vec3& x) const {
    int nearest = -1;
    double smallest = 0;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) {
          const auto found = buckets_.find(key(x + apart_ * Vec3(i, j, k)));
          if (found == buckets_.end()) continue;
          for (const int p : found->second)
            if (const double d = (points_[p] - x).squaredNorm(); nearest < 0 || d < smallest) nearest = p, smallest = d;
        }
    return nearest;
  }
  void add_if_apart(const Vec3& x) {
    if (const int near = nearest(x); near >= 0 && (points_[near] - x).norm() < apart_) return;
    buckets_[key(x)].push_back(static_cast<int>(points_.size()));
    points_.push_back(x);
  }
  int count() const { return static_cast<int>(points_.size()); }

 private:
  // A collision of hash numbers only adds pairs to examine.
  long key(const Vec3& x) const {
    const auto at = [&](int i) { return std::lround(std::floor(x[i] / apart_)); };
    return at(0) * 73856093L ^ at(1) * 19349663L ^ at(2) * 83492791L;
  }

  double apart_;
  std::vector<Vec3> points_;
  std::unordered_map<long, std::vector<int>> buckets_;
};

bool elastic(const ObjectConfig& object) {
  return std::any_of(object.energies.begin(), object.energies.end(), [](const auto& energy) { return energy->poisson().has_value(); });
}

std::string few_cells(const SlenderSolid& solid, const std::string& name) {
  return fmt::format("'{}' has at most {} linear tets across (2 V / A: {:.3g} m)", name, solid.cells, solid.thickness);
}

}  // namespace

SlenderSolid::SlenderSolid(int number, const Body& of, const VecX& rest, double across, int most_cells)
    : body(number), thickness(across), cells(most_cells), tets_(of.tets) {
  for (const Tet& t : tets_) {
    const Mat3 edges = edges_of(t, rest);
    from_rest_.push_back(edges.inverse());
    volume_.push_back(edges.determinant() / 6);
  }
  make_patches(rest);
}

void SlenderSolid::make_patches(const VecX& rest) {
  SparsePoints middles(patch_width * thickness);
  const auto centre = [&](const Tet& t) -> Vec3 {
    return (vertex(rest, t[0]) + vertex(rest, t[1]) + vertex(rest, t[2]) + vertex(rest, t[3])) / 4;
  };
  for (const Tet& t : tets_) middles.add_if_apart(centre(t));
  for (const Tet& t : tets_) patch_.push_back(middles.nearest(centre(t)));
  patches_ = middles.count();
}

void SlenderSolid::examine(const VecX& x) {
  std::vector<Mat3> sum(patches_, Mat3::Zero());
  std::vector<double> volume(patches_, 0);
  double square = 0, all = 0;
  for (size_t i = 0; i < tets_.size(); ++i) {
    const Mat3 f = edges_of(tets_[i], x) * from_rest_[i];
    const Mat3 strain = (f.transpose() * f - Mat3::Identity()) / 2;
    sum[patch_[i]] += volume_[i] * strain;
    volume[patch_[i]] += volume_[i];
    square += volume_[i] * strain.squaredNorm();
    all += volume_[i];
  }
  double of_means = 0;
  for (int p = 0; p < patches_; ++p)
    if (volume[p] > 0) of_means += sum[p].squaredNorm() / volume[p];
  stretched_ = std::max(stretched_, of_means / all);
  bent_ = std::max(bent_, (square - of_means) / all);
}

double SlenderSolid::bending_fraction() const {
  const double both = stretched_ + bent_;
  return both > least_strain * least_strain ? bent_ / both : 0;
}

BentSolids::BentSolids(const SceneConfig& scene, const World& world) : scene_(scene), world_(world) {
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    if (body.tets.empty() || !body.references.empty() || body.elements == Elements::composite || !body.movable || !body.frame.empty() || !elastic(scene.objects[i])) continue;
    const double thickness = thickness_of(body, world.rest);
    if (!(thickness > 0) || extent_of(body, world.rest).diagonal().norm() < slender * thickness) continue;
    if (const int cells = cells_across(body); cells < enough_cells)
      solids_.emplace_back(static_cast<int>(i), body, world.rest, thickness, cells);
  }
}

std::vector<std::string> BentSolids::notes() const {
  CopiedLines lines;
  for (const SlenderSolid& solid : solids_)
    lines.add(scene_.objects[solid.body], WarningKind::bending_locking,
               fmt::format("{}: where it bends, it will be too stiff, unless its `elements` are composite; {}", few_cells(solid, world_.bodies[solid.body].name), by_cells(world_.bodies[solid.body])));
  std::vector<std::string> texts;
  for (const Warning& line : lines.warnings()) texts.push_back(line.text);
  return texts;
}

void BentSolids::examine(const VecX& x) {
  for (SlenderSolid& solid : solids_) solid.examine(x);
}

std::vector<Warning> BentSolids::warnings() const {
  CopiedLines lines;
  for (const SlenderSolid& solid : solids_)
    if (solid.bending_fraction() > bends)
      lines.add(scene_.objects[solid.body], WarningKind::bending_locking,
                 fmt::format("{} and bends, in which it is too stiff: {}; use {} or more, `elements: composite`, or a shell",
                             few_cells(solid, world_.bodies[solid.body].name), by_cells(world_.bodies[solid.body]), enough_cells));
  return lines.warnings();
}

}  // namespace tack
