// Checks of glTF files: VTK reads beyond the end of buffers if a file announces too much.
#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "geometry/errors.hpp"
#include "geometry/io/precheck.hpp"
#include "geometry/io/printable.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

InputError damaged(const std::string& name, const std::string& what) {
  return InputError(fmt::format("{}: not a valid file of its format ({}): export it again, or as one of .obj .ply .off .stl", name, what));
}

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  if (bytes.size() >= at + 4) std::memcpy(&number, bytes.data() + at, 4);
  return number;
}

struct Chunks {
  std::string json;
  std::uint64_t binary = 0;  // bytes of the binary chunk
};

// Returns the chunks of a .glb: "glTF", version, length, then chunks of length, kind and content.
Chunks chunks_of(std::string bytes, const std::string& name) {
  if (!bytes.starts_with("glTF")) return {std::move(bytes), 0};
  Chunks chunks;
  if (number_at(bytes, 8) != bytes.size()) throw damaged(name, fmt::format("it has {} bytes, and says {}", bytes.size(), number_at(bytes, 8)));
  const std::uint64_t length = number_at(bytes, 12), next = 20 + length;
  if (bytes.compare(16, 4, "JSON") != 0 || next > bytes.size()) throw damaged(name, "its first chunk is no JSON, or cut");
  if (next + 8 <= bytes.size()) {
    chunks.binary = number_at(bytes, next);
    if (next + 8 + chunks.binary > bytes.size()) throw damaged(name, "its data are cut");
  }
  chunks.json = bytes.substr(20, length);
  return chunks;
}

std::uint64_t bytes_behind(const Json& buffer, const Chunks& chunks, const fs::path& folder) {
  if (!buffer.contains("uri")) return chunks.binary;
  const std::string uri = buffer["uri"];
  const std::size_t comma = uri.find(',');
  if (uri.starts_with("data:") && comma != uri.npos) {
    const std::uint64_t digits = uri.find_last_not_of('=') - comma;
    return digits * 3 / 4;
  }
  std::error_code none;
  const std::uintmax_t size = fs::file_size(folder / uri, none);
  return none ? std::numeric_limits<std::uint64_t>::max() : size;  // VTK reports a missing file
}

// Returns a number of an entry; the format omits zeros.
std::uint64_t number(const Json& entry, const char* key) { return entry.value(key, std::uint64_t(0)); }

void check(const Json& document, const Chunks& chunks, const std::string& name) {
  const std::map<int, std::uint64_t> sizes = {{5120, 1}, {5121, 1}, {5122, 2}, {5123, 2}, {5125, 4}, {5126, 4}};
  const std::map<std::string, std::uint64_t> counts = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  const Json none = Json::array();
  const Json& buffers = document.contains("buffers") ? document["buffers"] : none;
  const Json& views = document.contains("bufferViews") ? document["bufferViews"] : none;
  for (std::size_t i = 0; i < buffers.size(); ++i)
    if (number(buffers[i], "byteLength") > bytes_behind(buffers[i], chunks, fs::path(name).parent_path()))
      throw damaged(name, fmt::format("buffer {} has less than the {} bytes that it should", i, number(buffers[i], "byteLength")));
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Json& buffer = buffers.at(number(views[i], "buffer"));
    if (number(views[i], "byteOffset") + number(views[i], "byteLength") > number(buffer, "byteLength"))
      throw damaged(name, fmt::format("view {} goes beyond its buffer", i));
  }
  if (!document.contains("accessors")) return;
  for (std::size_t i = 0; i < document["accessors"].size(); ++i) {
    const Json& accessor = document["accessors"][i];
    if (!accessor.contains("bufferView") || number(accessor, "count") == 0) continue;
    const Json& view = views.at(number(accessor, "bufferView"));
    const std::uint64_t size = sizes.at(accessor.at("componentType")) * counts.at(accessor.at("type")), stride = std::max(size, number(view, "byteStride"));
    const std::uint64_t length = number(view, "byteLength");
    if (number(accessor, "count") > length || stride > length || number(accessor, "byteOffset") > length || number(accessor, "byteOffset") + stride * (number(accessor, "count") - 1) + size > length)
      throw damaged(name, fmt::format("accessor {} goes beyond its view", i));
  }
}

}  // namespace

void precheck_gltf(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  const Chunks chunks = chunks_of({std::istreambuf_iterator<char>(file), {}}, name);
  try {
    check(Json::parse(chunks.json), chunks, name);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {  // invalid JSON, or indices out of range
    throw damaged(name, printable(error.what(), 200));
  }
}

}  // namespace tack
