#include "geometry/broad_phase/rivals.hpp"

#include <algorithm>

namespace tack {

Rivals::Rivals(const CollisionMesh& mesh) : mesh_(mesh) {
  if (mesh.vertex_group.empty()) return;
  constexpr int unknown = -2;
  for (const int v : mesh.vertices) {
    const int object = mesh.vertex_object[v], group = mesh.vertex_group[v];
    if (object >= static_cast<int>(kin_of_.size())) kin_of_.resize(object + 1, unknown);
    int& kin = kin_of_[object];
    kin = kin == unknown || kin == group ? group : -1;
    if (group >= static_cast<int>(near_.size())) near_.resize(group + 1);
  }
}

void Rivals::find(const std::vector<Aabb>& vertex_boxes, const std::vector<double>& reach) {
  if (near_.empty()) return;
  boxes_.assign(kin_of_.size(), Aabb());
  std::vector<Aabb> of_group(near_.size());
  for (const int v : mesh_.vertices) {
    Aabb box = vertex_boxes[v];
    box.inflate(reach[mesh_.vertex_object[v]]);
    boxes_[mesh_.vertex_object[v]].include(box);
    if (const int group = mesh_.vertex_group[v]; group >= 0) of_group[group].include(box);
  }
  for (size_t group = 0; group < near_.size(); ++group) {
    near_[group].clear();
    for (size_t object = 0; object < boxes_.size(); ++object)
      if (kin_of_[object] != static_cast<int>(group) && boxes_[object].overlaps(of_group[group]))
        near_[group].push_back(static_cast<int>(object));
  }
}

}  // namespace tack
