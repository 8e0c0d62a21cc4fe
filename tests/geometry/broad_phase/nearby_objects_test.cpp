// Nearby objects of rigid groups against brute force.
#include "geometry/broad_phase/nearby_objects.hpp"

#include <catch2/catch.hpp>

#include "geometry/broad_phase/changed_primitives.hpp"
#include "tests/geometry/broad_phase/scenes.hpp"

using namespace tack;

TEST_CASE("an object outside a rigid group is near a box of it if the boxes overlap, by brute force", "[broad_phase]") {
  std::mt19937 random(1);
  int near = 0, far = 0;
  for (int trial = 0; trial < 50; ++trial) {
    // Objects of two vertices each. Objects 0 and 1 are one group, 2 is another one, half of 3 is in the first.
    scenes::Scene scene;
    for (int object = 0; object < 6; ++object)
      for (int i = 0; i < 2; ++i) scene.add_vertex(scenes::random_point(random, 1), object);
    scene.mesh.vertex_group = {0, 0, 0, 0, 1, 1, 0, -1, -1, -1, -1, -1};
    std::vector<Aabb> boxes(12);
    const VecX x = scene.x();
    for (int v = 0; v < 12; ++v) {
      boxes[v].include(Vec3(vertex(x, v)));
      boxes[v].inflate(0.02);
    }
    const std::vector<double> radius = {0.1, 0.02, 0.1, 0.05, 0, 0.1};
    NearbyObjects objects(scene.mesh);
    objects.find(boxes, radius);
    const auto box_of = [&](const auto& contains) {
      Aabb all;
      for (int v = 0; v < 12; ++v)
        if (contains(v)) {
          Aabb box = boxes[v];
          box.inflate(radius[scene.mesh.vertex_object[v]]);
          all.include(box);
        }
      return all;
    };
    for (int group = 0; group < 2; ++group) {
      Aabb query;
      query.include(scenes::random_point(random, 1));
      query.inflate(0.2);
      bool expected = false;
      for (int object = 0; object < 6; ++object) {
        if ((group == 0 && object < 2) || (group == 1 && object == 2)) continue;  // all of it is in the group
        const Aabb box = box_of([&](int v) { return scene.mesh.vertex_object[v] == object; });
        expected = expected || box.overlaps(query);
      }
      CHECK(objects.near(group, query) == expected);
      (expected ? near : far)++;
    }
  }
  CHECK(near > 10);
  CHECK(far > 10);
}

TEST_CASE("changed primitives are those of the changed objects", "[broad_phase]") {
  const scenes::Scene scene = scenes::mixed(3, 4);
  ChangedPrimitives changed;
  for (const std::vector<char>& which : {std::vector<char>{0, 1, 0, 0}, {1, 0, 0, 1}, {0, 0, 0, 0}, {1, 1, 1, 1}}) {
    changed.mark(scene.mesh, which);
    for (size_t v = 0; v < scene.mesh.vertex_object.size(); ++v) CHECK(changed.vertices[v] == which[scene.mesh.vertex_object[v]]);
    for (size_t e = 0; e < scene.mesh.edges.size(); ++e) CHECK(changed.edges[e] == which[scene.mesh.vertex_object[scene.mesh.edges[e][1]]]);
    for (size_t t = 0; t < scene.mesh.triangles.size(); ++t) CHECK(changed.triangles[t] == which[scene.mesh.vertex_object[scene.mesh.triangles[t][2]]]);
  }
}
