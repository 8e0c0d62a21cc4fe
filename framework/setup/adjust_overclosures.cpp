#include "framework/setup/adjust_overclosures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "framework/scene/pair_configs.hpp"
#include "framework/setup/build_world.hpp"
#include "geometry/broad_phase/overlap_pairs.hpp"
#include "geometry/errors.hpp"
#include "geometry/mesh/overlap_depth.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int sweeps = 60;
constexpr size_t line_count_max = 10;

// Returns classes of objects by the names that pairs use for them.
ObjectClasses named_classes(const SceneConfig& scene) {
  std::map<std::vector<NamedAs>, int> known;
  std::vector<int> classes;
  for (const ObjectConfig& object : scene.objects) {
    std::vector<NamedAs> named;
    for (const PairConfig& pair : scene.contact->pairs)
      for (const PairSide& side : pair.between) named.push_back(named_as(object, side.object));
    classes.push_back(known.emplace(named, static_cast<int>(known.size())).first->second);
  }
  return ObjectClasses(std::move(classes));
}

struct OverlappingBoxes {
  bool accept(int a, int b) const { return a < b; }
  std::array<int, 2> pair(int a, int b) const { return {a, b}; }
};

class OverclosureAdjustment {
 public:
  OverclosureAdjustment(const SceneConfig& scene, const Value& root, const std::vector<Mesh>& meshes)
      : scene_(scene), contact_(*scene.contact), limit_(*contact_.overclosure_adjustment), root_(root), classes_(named_classes(scene)),
        configs_(scene, root, classes_), displacement_(meshes.size(), Vec3::Zero()), pushed_by_(meshes.size(), -1) {
    std::set<std::string> constrained;
    for (const ObjectConfig& object : scene.objects) {
      if (!object.attach.empty()) constrained.insert(object.name);
      for (const AttachConfig& attach : object.attach) constrained.insert(attach.to);
    }
    for (const auto& interaction : scene.interactions) {
      if (!interaction->keeps_placement()) continue;
      for (const std::string& name : interaction->objects())
        for (const ObjectConfig& object : scene.objects)
          if (named_as(object, name) != NamedAs::not_at_all) constrained.insert(object.name);
    }
    for (const ObjectConfig& object : scene.objects) free_.push_back(object.motion.empty() && !constrained.contains(object.name));
    for (const Mesh& mesh : meshes) surfaces_.emplace_back(mesh);
  }

  void run() {
    for (int i = 0; i < sweeps; ++i)
      if (!sweep()) return;
  }

  const std::vector<Vec3>& displacements() const { return displacement_; }

  // Throws for overlaps that the last sweep left.
  void refuse_remaining() const {
    for (const auto& [a, b] : near_pairs())
      if (const auto found = overlap(a, b)) refuse(a, b, *found);
  }

  std::vector<std::string> lines() const {
    std::vector<int> pushed;
    for (size_t i = 0; i < displacement_.size(); ++i)
      if (pushed_by_[i] >= 0) pushed.push_back(static_cast<int>(i));
    const size_t all = pushed.size();
    if (all > line_count_max) {
      std::stable_sort(pushed.begin(), pushed.end(), [&](int a, int b) { return displacement_[a].norm() > displacement_[b].norm(); });
      pushed.resize(line_count_max);
    }
    std::vector<std::string> lines;
    for (const int i : pushed)
      lines.push_back(fmt::format("'{}' is pushed by {:.4g} m, ({:.4g}, {:.4g}, {:.4g}), away from '{}'", name(i), displacement_[i].norm(), displacement_[i].x(),
                                  displacement_[i].y(), displacement_[i].z(), name(pushed_by_[i])));
    if (all > line_count_max) lines.push_back(fmt::format("... and {} more objects are pushed by less", all - line_count_max));
    return lines;
  }

 private:
  const std::string& name(int i) const { return scene_.objects[i].name; }
  double offset(int a, int b) const { return scene_.objects[a].contact_offset + scene_.objects[b].contact_offset; }
  double gap(int a, int b) const { return offset(a, b) + contact_.contact_distance / 2; }

  bool may_touch(int a, int b) const {
    const int entry = configs_.of(a, b);
    return (free_[a] || free_[b]) && (entry < 0 || contact_.pairs[entry].contact);
  }

  // Returns the pairs whose AABBs, inflated by the offset and half the contact distance, overlap; ascending.
  std::vector<std::array<int, 2>> near_pairs() const {
    std::vector<Aabb> boxes;
    for (size_t i = 0; i < surfaces_.size(); ++i) {
      Aabb& box = boxes.emplace_back(surfaces_[i].box());
      box.lo += displacement_[i];
      box.hi += displacement_[i];
      box.inflate(scene_.objects[i].contact_offset + contact_.contact_distance / 2);
    }
    const Bvh tree(boxes);
    std::vector<std::array<int, 2>> pairs;
    overlap_pairs(tree, tree, OverlappingBoxes{}, pairs);
    std::erase_if(pairs, [&](const auto& pair) { return !may_touch(pair[0], pair[1]); });
    return pairs;
  }

  // Returns the overlap of two objects that overlap or are closer than their offsets.
  std::optional<OverlapDepth> overlap(int a, int b) const {
    const double least = offset(a, b) + 1e-6 * contact_.contact_distance;
    const double deepest = 2 * limit_ + gap(a, b);
    auto found = overlap_depth(surfaces_[a], displacement_[a], surfaces_[b], displacement_[b], gap(a, b), deepest);
    return found && found->distance < least ? found : std::nullopt;
  }

  // Translates an object, limited to its remaining length.
  void translate(int i, const Vec3& by) {
    Vec3 to = displacement_[i] + by;
    if (to.norm() > limit_) to *= limit_ / to.norm();
    displacement_[i] = to;
  }

  // Returns true if any pair overlapped. Overlaps are found in parallel and resolved one by one.
  bool sweep() {
    const auto pairs = near_pairs();
    std::vector<std::optional<OverlapDepth>> overlaps(pairs.size());
    for_each(static_cast<int>(pairs.size()), [&](int i) { overlaps[i] = overlap(pairs[i][0], pairs[i][1]); }, 1);
    std::vector<char> changed(displacement_.size(), 0);
    bool any = false;
    for (size_t i = 0; i < pairs.size(); ++i) {
      if (!overlaps[i]) continue;
      any = true;
      const auto [a, b] = pairs[i];
      const auto found = changed[a] || changed[b] ? overlap(a, b) : overlaps[i];
      if (!found) continue;
      changed[a] |= free_[a], changed[b] |= free_[b];
      const double distance = gap(a, b) - found->distance;
      const double first = surfaces_[a].volume(), second = surfaces_[b].volume();
      const double fraction = !free_[a] ? 0 : !free_[b] ? 1 : second / (first + second);
      if (free_[a]) translate(a, fraction * distance * found->away), pushed_by_[a] = b;
      if (free_[b]) translate(b, (fraction - 1) * distance * found->away), pushed_by_[b] = a;
    }
    return any;
  }

  [[noreturn]] void refuse(int a, int b, const OverlapDepth& found) const {
    const auto at_limit = [&](int i) { return free_[i] && displacement_[i].norm() >= limit_ * (1 - 1e-9); };
    const std::string why = at_limit(a) || at_limit(b) ? fmt::format("'{}' would have to go farther than contact.overclosure_adjustment ({:.4g} m)", name(at_limit(a) ? a : b), limit_)
                                             : "surrounding objects leave no space";
    throw InputError(fmt::format("{}'{}' and '{}' {} at ({:.6g}, {:.6g}, {:.6g}) m, {:.4g} m {}, and could not be pushed apart: {}; move one of them "
                                 "(place.translate), or turn their contact off (contact.pairs, contact: false)",
                                 source_location(root_, "objects", static_cast<size_t>(b)), name(a), name(b), found.distance < 0 ? "overlap" : "are too close",
                                 found.at.x(), found.at.y(), found.at.z(), std::abs(found.distance), found.distance < 0 ? "deep" : "apart", why));
  }

  const SceneConfig& scene_;
  const ContactConfig& contact_;
  double limit_;  // m
  const Value& root_;
  ObjectClasses classes_;
  PairConfigs configs_;
  std::vector<SurfaceDistance> surfaces_;
  std::vector<char> free_;
  std::vector<Vec3> displacement_;  // m
  std::vector<int> pushed_by_;      // per object: the one it was moved away from last; -1: none
};

}  // namespace

std::vector<std::string> adjust_overclosures(const SceneConfig& scene, const Value& root, std::vector<Mesh>& meshes) {
  if (!scene.contact || !scene.contact->overclosure_adjustment) return {};
  OverclosureAdjustment adjustment(scene, root, meshes);
  adjustment.run();
  adjustment.refuse_remaining();
  for (size_t i = 0; i < meshes.size(); ++i)
    for (Vec3& x : meshes[i].vertices) x += adjustment.displacements()[i];
  return adjustment.lines();
}

}  // namespace tack
