// The JSON and the binary chunk of a .glb file (glTF 2.0 specification, sections 3.6 and 4.4).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

// Values of componentType and target.
inline constexpr int gltf_float = 5126, gltf_uint = 5125;
inline constexpr int gltf_vertices = 34962, gltf_indices = 34963, gltf_no_target = 0;

class GltfBuffer {
 public:
  // Append an accessor, with single-precision numbers, and return its index. bounds: with smallest
  // and largest values, which positions and times need.
  int add_vectors(const std::vector<Vec3>& vectors);  // with bounds
  int add_uvs(const std::vector<Vec2>& uvs);          // v counted from the top, as glTF has it
  int add_numbers(const std::vector<float>& numbers, bool bounds);
  int add_indices(const std::vector<int>& indices);

  // Returns the file. gltf: all properties but accessors, bufferViews and buffers. Throws
  // InputError, without the path, if the file would exceed 4 GiB.
  std::string file(nlohmann::ordered_json gltf);

 private:
  int add(const char* type, int component_type, int target, const void* data, size_t bytes,
          size_t count);
  nlohmann::ordered_json accessors_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json views_ = nlohmann::ordered_json::array();
  std::string bytes_;
};

}  // namespace tack
