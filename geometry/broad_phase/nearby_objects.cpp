#include "geometry/broad_phase/nearby_objects.hpp"

#include <bit>

#include "geometry/broad_phase/overlap_pairs.hpp"

namespace tack {

NearbyObjects::NearbyObjects(const CollisionMesh& mesh) : mesh_(mesh) {
  if (mesh.vertex_group.empty()) return;
  for (const int v : mesh.vertices) {
    const int object = mesh.vertex_object[v], group = mesh.vertex_group[v];
    if (object >= static_cast<int>(number_.size())) number_.resize(object + 1, -1);
    if (number_[object] < 0) {
      number_[object] = static_cast<int>(rigid_groups_.size());
      rigid_groups_.push_back(group);
    }
    int& common = rigid_groups_[number_[object]];
    if (common != group) common = -1;
  }
}

void NearbyObjects::find(const std::vector<Aabb>& vertex_boxes, const std::vector<double>& radius) {
  if (rigid_groups_.empty()) return;
  std::vector<Aabb> boxes(rigid_groups_.size());
  for (const int v : mesh_.vertices) {
    Aabb box = vertex_boxes[v];
    box.inflate(radius[mesh_.vertex_object[v]]);
    boxes[number_[mesh_.vertex_object[v]]].include(box);
  }
  if (boxes_.size() == 0) boxes_ = Bvh(boxes, {}, rigid_groups_);
  else boxes_.update(boxes);
}

bool NearbyObjects::near(int rigid_group, const Aabb& box) const {
  bool found = false;
  detail::visit_groups(boxes_, box, false, rigid_group, [&](int group) {
    for (unsigned lanes = boxes_.boxes(0, group).overlap_mask(box); lanes != 0 && !found; lanes &= lanes - 1)
      found = rigid_groups_[boxes_.primitives(group)[std::countr_zero(lanes)]] != rigid_group;
  });
  return found;
}

}  // namespace tack
