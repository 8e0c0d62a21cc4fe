// The mesh of an object in a glTF file: vertices with one pair of texture coordinates each, and
// primitives per material.
#pragma once

#include <vector>

#include "framework/export/run_shapes.hpp"

namespace tack {

struct GltfMesh {
  struct Primitive {
    int mode = 4;      // 0: points, 1: lines, 4: triangles
    int material = 0;  // of the object
    std::vector<int> indices;
  };
  std::vector<int> vertices;  // of the object, one per vertex of the file
  std::vector<Vec2> uvs;      // per vertex; empty: none
  std::vector<Primitive> primitives;
};

// x: positions of the object by which polygons are cut into triangles [m].
GltfMesh gltf_mesh(const ExportedObject& object, const std::vector<Vec3>& x);

}  // namespace tack
