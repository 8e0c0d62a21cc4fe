#include "framework/shapes/mesh_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>

#include "framework/config/field.hpp"
#include "framework/config/file_digest.hpp"
#include "framework/config/read_file.hpp"
#include "framework/config/yaml_text.hpp"
#include "geometry/checksum.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/mesh_bytes.hpp"
#include "geometry/meshing_library.hpp"
#include "geometry/own_library.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_file = std::uintmax_t{4} << 30;  // bytes

// Returns size and time of the program and of its library, which identify a build.
std::string this_program() {
  std::error_code none;
  const fs::path program = own_file();
  return fmt::format("{} {} {}", fs::file_size(program, none), fs::last_write_time(program, none).time_since_epoch().count(),
                     meshing_library_stamp());
}

void add_files(const Value& value, std::string& recipe) {
  const Value *type = value.find("type"), *path = value.find("path");
  if (type && path && type->text == "file") recipe += "\nfile " + file_digest(path->text);
  for (const Value& item : value.items) add_files(item, recipe);
  for (const Value::Entry& entry : value.entries) add_files(entry.value, recipe);
}

// Returns the FNV-1a hash.
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t h = 0xcbf29ce484222325ULL;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return h;
}

// Packs texts, each after its length, after a checksum of all of them.
std::string packed(const std::vector<std::string>& pieces) {
  std::string all;
  for (const std::string& piece : pieces) all += fmt::format("{}\n", piece.size()) + piece;
  return fmt::format("tack mesh {:08x}\n", crc32_of(all.data(), all.size())) + all;
}

std::vector<std::string> unpacked(const std::string& bytes) {
  const size_t start = bytes.find('\n');
  if (start == bytes.npos) return {};
  const std::string all = bytes.substr(start + 1);
  if (bytes.substr(0, start) != fmt::format("tack mesh {:08x}", crc32_of(all.data(), all.size()))) return {};
  std::vector<std::string> pieces;
  for (size_t at = 0; at < all.size();) {
    const size_t end = all.find('\n', at);
    if (end == all.npos) return {};
    const size_t size = std::strtoull(all.c_str() + at, nullptr, 10);
    if (size > all.size() - end - 1) return {};
    pieces.push_back(all.substr(end + 1, size));
    at = end + 1 + size;
  }
  return pieces;
}

class MeshCache {
 public:
  void set_folder(const fs::path& folder) { folder_ = folder; }

  std::shared_ptr<const ShapeMesh> mesh_of_shape(const ShapeSource& shape) {
    const std::string recipe = recipe_of(shape);
    const std::lock_guard lock(mutex_);  // recursive: a recipe may contain others; callers of the same mesh wait
    if (const auto found = meshes_.find(recipe); found != meshes_.end()) return found->second;
    auto mesh = from_file(recipe);
    if (!mesh) {
      mesh = std::make_shared<ShapeMesh>(ShapeMesh{shape.make(), shape.notes()});
      to_file(recipe, *mesh);
    }
    return meshes_[recipe] = mesh;
  }

 private:
  static std::string recipe_of(const ShapeSource& shape) {
    const Value value = to_value(&shape);
    static const std::string program = this_program();
    std::string recipe = program + "\n" + yaml_text(value);
    add_files(value, recipe);
    return recipe;
  }

  fs::path file_of(const std::string& recipe) const { return folder_ / fmt::format("{:016x}.mesh", hash_of(recipe)); }

  std::shared_ptr<const ShapeMesh> from_file(const std::string& recipe) const {
    if (folder_.empty() || !fs::is_regular_file(file_of(recipe))) return nullptr;
    try {
      const std::vector<std::string> pieces = unpacked(read_file(file_of(recipe), largest_file));
      if (pieces.size() < 2 || pieces[0] != recipe) return nullptr;
      auto mesh = mesh_from(pieces[1]);
      if (!mesh) return nullptr;
      return std::make_shared<ShapeMesh>(ShapeMesh{std::move(*mesh), {pieces.begin() + 2, pieces.end()}});
    } catch (const InputError&) {
      return nullptr;
    }
  }

  void to_file(const std::string& recipe, const ShapeMesh& mesh) const {
    if (folder_.empty()) return;
    std::vector<std::string> pieces{recipe, bytes_of(mesh.mesh)};
    pieces.insert(pieces.end(), mesh.notes.begin(), mesh.notes.end());
    std::error_code failed;
    fs::create_directories(folder_, failed);
    // Written to a draft and renamed: complete or missing, also if two processes write the same file.
    const fs::path file = file_of(recipe), draft = file.string() + fmt::format(".{}", getpid());
    std::ofstream(draft, std::ios::binary) << packed(pieces);
    fs::rename(draft, file, failed);
    if (failed) fs::remove(draft, failed);
  }

  fs::path folder_;
  std::recursive_mutex mutex_;
  std::map<std::string, std::shared_ptr<const ShapeMesh>> meshes_;
};

MeshCache& cache() {
  static MeshCache one;
  return one;
}

}  // namespace

std::shared_ptr<const ShapeMesh> mesh_of_shape(const ShapeSource& shape) {
  if (!shape.costly()) return std::make_shared<ShapeMesh>(ShapeMesh{shape.make(), shape.notes()});
  return cache().mesh_of_shape(shape);
}

void set_mesh_cache_folder(const fs::path& folder) { cache().set_folder(folder); }

fs::path default_mesh_cache_folder() {
  const char* said = std::getenv("TACK_MESHES");
  if (!said || !*said) return "results/meshes";
  return std::string(said) == "none" ? fs::path() : fs::path(said);
}

}  // namespace tack
