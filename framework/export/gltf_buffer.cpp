#include "framework/export/gltf_buffer.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "geometry/errors.hpp"

namespace tack {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little);

void append_word(std::string& bytes, std::uint32_t word) { bytes.append(reinterpret_cast<const char*>(&word), 4); }

void pad(std::string& bytes, char with) { bytes.append((4 - bytes.size() % 4) % 4, with); }

}  // namespace

int GltfBuffer::add(const char* type, int component_type, int target, const void* data, size_t size, size_t count) {
  Json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
  if (target != gltf_no_target) view["target"] = target;
  views_.push_back(std::move(view));
  bytes_.append(static_cast<const char*>(data), size);
  accessors_.push_back({{"bufferView", views_.size() - 1}, {"componentType", component_type}, {"count", count}, {"type", type}});
  return static_cast<int>(accessors_.size()) - 1;
}

int GltfBuffer::add_vectors(const std::vector<Vec3>& vectors) {
  std::vector<float> numbers;
  numbers.reserve(3 * vectors.size());
  std::array<float, 3> low, high;
  low.fill(std::numeric_limits<float>::max());
  high.fill(std::numeric_limits<float>::lowest());
  for (const Vec3& v : vectors)
    for (int c = 0; c < 3; ++c) {
      numbers.push_back(static_cast<float>(v[c]));
      low[c] = std::min(low[c], numbers.back());
      high[c] = std::max(high[c], numbers.back());
    }
  const int accessor = add("VEC3", gltf_float, gltf_vertices, numbers.data(), 4 * numbers.size(), vectors.size());
  accessors_[accessor]["min"] = low;
  accessors_[accessor]["max"] = high;
  return accessor;
}

int GltfBuffer::add_uvs(const std::vector<Vec2>& uvs) {
  std::vector<float> numbers;
  for (const Vec2& uv : uvs) {
    numbers.push_back(static_cast<float>(uv[0]));
    numbers.push_back(static_cast<float>(1 - uv[1]));
  }
  return add("VEC2", gltf_float, gltf_vertices, numbers.data(), 4 * numbers.size(), uvs.size());
}

int GltfBuffer::add_numbers(const std::vector<float>& numbers, bool bounds) {
  const int accessor = add("SCALAR", gltf_float, gltf_no_target, numbers.data(), 4 * numbers.size(), numbers.size());
  if (bounds) {
    accessors_[accessor]["min"] = {*std::min_element(numbers.begin(), numbers.end())};
    accessors_[accessor]["max"] = {*std::max_element(numbers.begin(), numbers.end())};
  }
  return accessor;
}

int GltfBuffer::add_indices(const std::vector<int>& indices) {
  const std::vector<std::uint32_t> numbers(indices.begin(), indices.end());
  return add("SCALAR", gltf_uint, gltf_indices, numbers.data(), 4 * numbers.size(), numbers.size());
}

std::string GltfBuffer::file(Json gltf) {
  gltf["accessors"] = accessors_;
  gltf["bufferViews"] = views_;
  gltf["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
  std::string json = gltf.dump(-1, ' ', false, Json::error_handler_t::replace);  // names of materials need not be UTF-8
  pad(json, ' ');
  pad(bytes_, '\0');
  const size_t length = 12 + 8 + json.size() + 8 + bytes_.size();
  if (length > std::numeric_limits<std::uint32_t>::max())
    throw InputError("a .glb file has at most 4 GiB; write fewer frames (frames) or fewer objects (objects)");
  std::string file = "glTF";
  append_word(file, 2);
  append_word(file, static_cast<std::uint32_t>(length));
  append_word(file, static_cast<std::uint32_t>(json.size()));
  file += "JSON";
  file += json;
  append_word(file, static_cast<std::uint32_t>(bytes_.size()));
  file += std::string("BIN\0", 4);
  file += bytes_;
  return file;
}

}  // namespace tack
