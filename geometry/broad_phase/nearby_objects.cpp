#include "geometry/broad_phase/nearby_objects.hpp"

#include <algorithm>

namespace tack {

NearbyObjects::NearbyObjects(const CollisionMesh& mesh) : mesh_(mesh) {
  if (mesh.vertex_group.empty()) return;
  constexpr int unknown = -2;
  for (const int v : mesh.vertices) {
    const int object = mesh.vertex_object[v], group = mesh.vertex_group[v];
    if (object >= static_cast<int>(group_of_object_.size())) group_of_object_.resize(object + 1, unknown);
    int& rigid_group = group_of_object_[object];
    rigid_group = rigid_group == unknown || rigid_group == group ? group : -1;
    if (group >= static_cast<int>(near_.size())) near_.resize(group + 1);
  }
}

void NearbyObjects::find(const std::vector<Aabb>& vertex_boxes, const std::vector<double>& radius) {
  if (near_.empty()) return;
  boxes_.assign(group_of_object_.size(), Aabb());
  std::vector<Aabb> of_group(near_.size());
  for (const int v : mesh_.vertices) {
    Aabb box = vertex_boxes[v];
    box.inflate(radius[mesh_.vertex_object[v]]);
    boxes_[mesh_.vertex_object[v]].include(box);
    if (const int group = mesh_.vertex_group[v]; group >= 0) of_group[group].include(box);
  }
  for (size_t group = 0; group < near_.size(); ++group) {
    near_[group].clear();
    for (size_t object = 0; object < boxes_.size(); ++object)
      if (group_of_object_[object] != static_cast<int>(group) && boxes_[object].overlaps(of_group[group]))
        near_[group].push_back(static_cast<int>(object));
  }
}

}  // namespace tack
