#include "energies/solid/patch_volumes.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <numeric>

#include "geometry/tet_edges.hpp"
#include "geometry/tets/tet_patches.hpp"

namespace tack {

static_assert(largest_patch == largest_rank_one);

namespace {

std::vector<std::vector<int>> vertices_of_patches(const std::vector<Tet>& tets, const std::vector<int>& patch) {
  std::vector<std::vector<int>> all(patch.empty() ? 0 : static_cast<size_t>(*std::max_element(patch.begin(), patch.end())) + 1);
  for (size_t t = 0; t < tets.size(); ++t) all[patch[t]].insert(all[patch[t]].end(), tets[t].begin(), tets[t].end());
  for (auto& vertices : all) {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }
  return all;
}

}  // namespace

Patches::Sorted Patches::sorted(const Body& body) {
  const std::vector<int> patch = tet_patches(body.tets);
  const auto vertices = vertices_of_patches(body.tets, patch);
  std::vector<int> order(body.tets.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int t) { return std::tuple(vertices[patch[t]].size(), patch[t], t); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  Sorted out{body, {}};
  for (size_t i = 0, number = 0; i < order.size(); ++i) {
    out.body.tets[i] = body.tets[order[i]];
    if (i > 0 && patch[order[i]] != patch[order[i - 1]]) ++number;
    out.patch.push_back(static_cast<int>(number));
  }
  return out;
}

Patches::Patches(const Sorted& sorted, const VecX& rest) : tets_(sorted.body.tets), patch_of_(sorted.patch) {
  const int n = static_cast<int>(tets_.size());
  for (const auto& vertices : vertices_of_patches(tets_, patch_of_)) {
    patches_.push_back({0, 0, static_cast<int>(vertices_.size()), static_cast<int>(vertices.size()), 0});
    vertices_.insert(vertices_.end(), vertices.begin(), vertices.end());
    if (runs_.empty() || patches_[runs_.back().first].size != patches_.back().size) runs_.push_back({count() - 1, 0});
    ++runs_.back().count;
  }
  corners_.resize(tets_.size());
  for (int t = 0; t < n; ++t) {
    Patch& patch = patches_[patch_of_[t]];
    if (patch.last == 0) patch.first = t;
    patch.last = t + 1;
    rest_.push_back(edges_of(tets_[t], rest).determinant());
    patch.volume += rest_.back() / 6;
    const int* const first = &vertices_[patch.vertices];
    for (int i = 0; i < 4; ++i) corners_[t][i] = static_cast<int>(std::lower_bound(first, first + patch.size, tets_[t][i]) - first);
  }
}

double Patches::growth(int p, const VecX& x) const {
  const Patch& patch = patches_[p];
  double change = 0;
  for (int t = patch.first; t < patch.last; ++t) change += edges_of(tets_[t], x).determinant() - rest_[t];
  return change / (6 * patch.volume);
}

void Patches::derivative(int p, const VecX& x, double* out) const {
  const Patch& patch = patches_[p];
  std::fill(out, out + 3 * patch.size, 0.0);
  for (int t = patch.first; t < patch.last; ++t) {
    const Mat3 e = edges_of(tets_[t], x);
    const Vec3 faces[3] = {e.col(1).cross(e.col(2)), e.col(2).cross(e.col(0)), e.col(0).cross(e.col(1))};
    const auto add = [&](int corner, const Vec3& area) { Eigen::Map<Vec3>(out + 3 * corners_[t][corner]) += area / (6 * patch.volume); };
    for (int i = 0; i < 3; ++i) add(i + 1, faces[i]);
    add(0, -(faces[0] + faces[1] + faces[2]));
  }
}

StencilBatch Patches::batch(const Run& run) const {
  StencilBatch batch{patches_[run.first].size, run.count, vertices(run.first)};
  batch.rank_one = true;
  return batch;
}

}  // namespace tack
