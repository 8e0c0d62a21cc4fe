#include "framework/scene/fill.hpp"

#include <fmt/format.h>

#include <random>
#include <unordered_map>

#include "framework/scene/scene_config.hpp"
#include "framework/shapes/mesh_cache.hpp"
#include "geometry/errors.hpp"
#include "geometry/level_set/zero_surface.hpp"
#include "geometry/mesh/mass_properties.hpp"
#include "geometry/broad_phase/sphere_tree.hpp"

namespace tack {

void FillConfig::fields(Fields& f) {
  f.component("region", region, "region that contains the copies, with at least the clearance to its boundary").required();
  f.optional_integer("count", count, "number of copies").at_least(1);
  f.optional_number("packing", packing, units::none, "volume of the copies over the volume of the region, instead of a count").positive().below(0.7);
  f.number("clearance", clearance, units::length, "smallest distance between copies").required().positive();
  f.flag("rotate", rotate, "rotate copies at random");
  f.integer("seed", seed, "random seed of the positions").at_least(0);
  f.choice("into", into, {{"objects", Into::objects, "each copy is an object, NAME_1 and so on, in a group NAME"},
                          {"one", Into::one, "all copies are one object, which is in contact with itself"}}, "objects that the copies become");
  f.check("count", [this]() -> std::string { return count.has_value() != packing.has_value() ? "" : "give either count or packing"; });
}

namespace {

using Pose = Eigen::Isometry3d;

class Random {
 public:
  explicit Random(int seed) : bits_(static_cast<std::uint64_t>(seed)) {}
  double number() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }  // in [0, 1)
  // Returns a uniformly distributed rotation (Shoemake 1992).
  Eigen::Quaterniond rotation() {
    const double u = number(), a = 2 * M_PI * number(), b = 2 * M_PI * number();
    const double p = std::sqrt(1 - u), q = std::sqrt(u);
    return {p * std::sin(a), p * std::cos(a), q * std::sin(b), q * std::cos(b)};
  }

 private:
  std::mt19937_64 bits_;
};

// Copies placed so far, in the cells of a grid.
class PlacedCopies {
 public:
  PlacedCopies(const SphereTree& tree, double clearance) : tree_(tree), clearance_(clearance), cell_(2 * tree.radius() + clearance) {}

  // Returns true if a copy at `pose` keeps its distance from all others.
  bool fits(const Pose& pose) const {
    const auto c = cell(pose);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          if (const auto found = cells_.find(key({c[0] + i, c[1] + j, c[2] + k})); found != cells_.end())
            for (const size_t other : found->second)
              if (!farther_than(tree_, pose, tree_, poses_[other], clearance_)) return false;
    return true;
  }
  void add(const Pose& pose) {
    cells_[key(cell(pose))].push_back(poses_.size());
    poses_.push_back(pose);
  }
  const std::vector<Pose>& poses() const { return poses_; }

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell(const Pose& pose) const {
    const Vec3 at = pose * tree_.centre();
    Cell c;
    for (int k = 0; k < 3; ++k) c[k] = static_cast<std::int64_t>(std::floor(at[k] / cell_));
    return c;
  }
  static std::uint64_t key(const Cell& c) {
    std::uint64_t h = 0;
    for (const std::int64_t n : c) h = (h << 21) ^ (static_cast<std::uint64_t>(n) & 0x1fffff);
    return h;
  }

  const SphereTree& tree_;
  double clearance_, cell_;
  std::vector<Pose> poses_;
  std::unordered_map<std::uint64_t, std::vector<size_t>> cells_;
};

// Places the copies of one fill. Poses are relative to the mesh's own placement.
class Filler {
 public:
  Filler(const FillConfig& fill, const Mesh& mesh) : fill_(fill), mesh_(mesh), tree_(mesh), copies_(tree_, fill.clearance), random_(fill.seed) {
    if (mesh.vertices.empty()) throw InputError("fill: the shape has no vertices");
    // Grids of the region get cells a quarter of the copy's radius, or half of the clearance.
    fill.region->prepare(std::max(tree_.radius() / 4, fill.clearance / 2));
    box_ = fill.region->bounds();
    if (box_.isEmpty() || !finite(box_)) throw InputError("fill.region: must be bounded and not empty");
  }

  std::vector<Pose> poses() {
    const int target_count = count();
    constexpr int failure_count_max = 20000;  // consecutive failures
    for (int failures = 0; static_cast<int>(copies_.poses().size()) < target_count;) {
      const Pose pose = random_pose();
      if (within(pose) && copies_.fits(pose)) copies_.add(pose), failures = 0;
      else if (++failures == failure_count_max)
        throw InputError(fmt::format("fill: {} of {} copies were placed, then {} attempts in a row failed; ask for fewer, or for less clearance "
                                     "({:.4g} m), or widen the region", copies_.poses().size(), target_count, failure_count_max, fill_.clearance));
    }
    return copies_.poses();
  }

 private:
  int count() const {
    if (fill_.count) return *fill_.count;
    const double voxel = box_.sizes().maxCoeff() / 96;
    const Mesh surface = zero_surface([this](auto points, auto values) { fill_.region->evaluate(points, values); }, box_, voxel);
    return std::max(1, static_cast<int>(std::lround(*fill_.packing * mass_properties(surface).volume / mass_properties(mesh_).volume)));
  }

  // Returns a pose with its centre at a random position in the box.
  Pose random_pose() {
    Vec3 at;
    for (int k = 0; k < 3; ++k) at[k] = box_.min()[k] + box_.sizes()[k] * random_.number();
    Pose pose = Pose::Identity();
    if (fill_.rotate) pose.linear() = random_.rotation().toRotationMatrix();
    pose.translation() = at - pose.linear() * tree_.centre();
    return pose;
  }

  bool within(const Pose& pose) const {
    double middle = 0;
    const Vec3 centre = pose * tree_.centre();
    fill_.region->evaluate({&centre, 1}, {&middle, 1});
    if (middle <= -(tree_.radius() + fill_.clearance)) return true;
    if (middle > -fill_.clearance) return false;
    std::vector<Vec3> points;
    points.reserve(mesh_.vertices.size());
    for (const Vec3& x : mesh_.vertices) points.push_back(pose * x);
    std::vector<double> values(points.size());
    fill_.region->evaluate(points, values);
    return std::all_of(values.begin(), values.end(), [&](double value) { return value <= -fill_.clearance; });
  }

  const FillConfig& fill_;
  const Mesh& mesh_;
  SphereTree tree_;
  PlacedCopies copies_;
  Random random_;
  Eigen::AlignedBox3d box_;
};

Value vector_value(const Vec3& v) { return Value::sequence({Value::number(v.x()), Value::number(v.y()), Value::number(v.z())}); }

// Returns the placement of a copy: that of the object, followed by the pose.
Value placement_value(const MeshPlacement& placement, const Pose& pose) {
  const Mat3 rotation = placement.angle == 0 ? Mat3(Mat3::Identity()) : Mat3(Eigen::AngleAxisd(placement.angle, placement.axis.normalized()));
  const Eigen::AngleAxisd new_rotation(Mat3(pose.linear() * rotation));
  Value value = Value::map();
  value.set("scale", vector_value(placement.scale));
  value.set("axis", vector_value(new_rotation.axis()));
  value.set("angle", Value::number(new_rotation.angle()));
  value.set("translate", vector_value(pose * placement.translate));
  return value;
}

void erase(Value& map, std::string_view key) {
  std::erase_if(map.entries, [&](const Value::Entry& entry) { return entry.key == key; });
}

void add_copies(const Value& entry, const ObjectConfig& object, const std::vector<Pose>& poses, std::vector<Value>& to) {
  Value copy = entry;
  erase(copy, "fill");
  if (object.fill->into == FillConfig::Into::one) {
    Value parts = Value::sequence();
    for (const Pose& pose : poses) {
      Value part = Value::map();
      part.set("shape", *entry.find("shape"));
      part.set("place", placement_value(object.placement, pose));
      parts.items.push_back(std::move(part));
    }
    Value shape = Value::map();
    shape.set("type", Value::scalar("parts"));
    shape.set("parts", std::move(parts));
    copy.set("shape", std::move(shape));
    erase(copy, "place");
    to.push_back(std::move(copy));
    return;
  }
  Value groups = Value::sequence();
  for (const std::string& group : object.groups) groups.items.push_back(Value::scalar(group));
  groups.items.push_back(Value::scalar(object.name));
  copy.set("groups", std::move(groups));
  for (size_t i = 0; i < poses.size(); ++i) {
    Value one = copy;
    one.set("name", Value::scalar(fmt::format("{}_{}", object.name, i + 1)));
    one.set("place", placement_value(object.placement, poses[i]));
    to.push_back(std::move(one));
  }
}

}  // namespace

Value expand_fills(Value root, const SceneConfig& scene) {
  Value* objects = root.find("objects");
  std::vector<Value> entries;
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    const ObjectConfig& object = scene.objects[i];
    const Value& entry = objects->items[i];
    if (!object.fill) {
      entries.push_back(entry);
      continue;
    }
    try {
      Mesh mesh = mesh_of_shape(*object.shape)->mesh;
      object.placement.apply(mesh);
      add_copies(entry, object, Filler(*object.fill, mesh).poses(), entries);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: object '{}': {}", entry.mark.text(), object.name, error.what()));
    }
  }
  objects->items = std::move(entries);
  return root;
}

}  // namespace tack
