#include "geometry/tets/tet_patches.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <map>
#include <set>

#include "geometry/shapes/solids.hpp"
#include "geometry/tets/divide_tets.hpp"

using namespace tack;

namespace {

std::map<int, std::vector<int>> members(const std::vector<int>& patch) {
  std::map<int, std::vector<int>> all;
  for (size_t t = 0; t < patch.size(); ++t) all[patch[t]].push_back(static_cast<int>(t));
  return all;
}

size_t vertices(const std::vector<Tet>& tets, const std::vector<int>& of) {
  std::set<int> all;
  for (const int t : of) all.insert(tets[t].begin(), tets[t].end());
  return all.size();
}

}  // namespace

TEST_CASE("patches of meshes of cells are the cells", "[tet_patches]") {
  for (const Mesh& mesh : {box_tets({1, 2, 3}, {3, 2, 4}), sphere(1, 6), cylinder(1, 2, 4, 5), voussoir({}, {3, 2, 2})}) {
    const std::vector<int> patch = tet_patches(mesh.tets);
    for (size_t t = 0; t < patch.size(); ++t) CHECK(patch[t] == static_cast<int>(t / 6));
  }
}

TEST_CASE("patches of other meshes are connected, large enough and not too large, whatever the order of tets", "[tet_patches]") {
  // Divided tets, in an order in which no six consecutive ones are a cell.
  Mesh mesh = divide_tets(sphere(1, 6));
  for (const int stride : {7, 101}) {
    std::vector<Tet> tets;
    for (int first = 0; first < stride; ++first)
      for (size_t t = static_cast<size_t>(first); t < mesh.tets.size(); t += static_cast<size_t>(stride)) tets.push_back(mesh.tets[t]);
    const std::vector<int> patch = tet_patches(tets);
    REQUIRE(patch.size() == tets.size());
    CHECK(patch[0] == 0);
    const auto all = members(patch);
    CHECK(static_cast<int>(all.size()) == *std::max_element(patch.begin(), patch.end()) + 1);
    size_t small = 0;
    for (const auto& [number, of] : all) {
      CHECK(vertices(tets, of) <= static_cast<size_t>(largest_patch));
      small += of.size() < 3;
      // Connected through shared vertices.
      std::set<int> reached(tets[of[0]].begin(), tets[of[0]].end());
      std::vector<int> left(of.begin() + 1, of.end());
      for (bool grew = true; grew;) {
        grew = false;
        for (auto t = left.begin(); t != left.end();) {
          const bool touches = std::any_of(tets[*t].begin(), tets[*t].end(), [&](int v) { return reached.contains(v); });
          if (touches) reached.insert(tets[*t].begin(), tets[*t].end()), t = left.erase(t), grew = true;
          else ++t;
        }
      }
      CHECK(left.empty());
    }
    CHECK(static_cast<double>(small) <= 0.02 * static_cast<double>(all.size()));
    const double mean = static_cast<double>(tets.size()) / static_cast<double>(all.size());
    CHECK(mean > 6);
    CHECK(mean < 20);
  }
}

TEST_CASE("patches of few tets", "[tet_patches]") {
  CHECK(tet_patches({}).empty());
  CHECK(tet_patches({{0, 1, 2, 3}}) == std::vector<int>{0});
  CHECK(tet_patches({{0, 1, 2, 3}, {1, 2, 3, 4}}) == std::vector<int>{0, 0});
  CHECK(tet_patches({{0, 1, 2, 3}, {5, 6, 7, 8}}) == std::vector<int>{0, 1});  // nothing in common
}
