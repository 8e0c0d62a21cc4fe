#include "framework/export/source_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <sstream>

#include "geometry/errors.hpp"
#include "geometry/io/file_faces.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

// Collects the files with polygons of a shape and of those that it is made of.
void collect_files(const Value& value, std::vector<std::string>& found) {
  const Value* path = value.find("path");
  if (path && path->is_scalar() && has_file_faces(path->text)) found.push_back(path->text);
  for (const Value& item : value.items) collect_files(item, found);
  for (const Value::Entry& entry : value.entries) collect_files(entry.value, found);
}

// Rotates the smallest index to the front, so that equal oriented triangles are equal.
Triangle rotated(const Triangle& t) {
  const auto i = std::min_element(t.begin(), t.end()) - t.begin();
  return {t[i], t[(i + 1) % 3], t[(i + 2) % 3]};
}

std::vector<Triangle> sorted(const std::vector<Triangle>& triangles, bool mirrored) {
  std::vector<Triangle> list;
  for (const Triangle& t : triangles) list.push_back(rotated(mirrored ? Triangle{t[0], t[2], t[1]} : t));
  std::sort(list.begin(), list.end());
  return list;
}

std::map<std::string, Vec3> diffuse_colours(const fs::path& library) {
  std::map<std::string, Vec3> colours;
  std::ifstream file(library);
  std::string line, name;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "newmtl") words >> name;
    Vec3 colour;
    if (key == "Kd" && words >> colour[0] >> colour[1] >> colour[2]) colours[name] = colour.cwiseMax(0).cwiseMin(1);
  }
  return colours;
}

void reverse_faces(ExportedObject& object) {
  size_t begin = 0;
  for (const int size : object.face_sizes) {
    std::reverse(object.corners.begin() + begin, object.corners.begin() + begin + size);
    if (!object.corner_uvs.empty()) std::reverse(object.corner_uvs.begin() + begin, object.corner_uvs.begin() + begin + size);
    begin += size;
  }
}

void take_materials(const FileFaces& faces, const fs::path& folder, ExportedObject& object) {
  std::map<std::string, Vec3> colours;
  for (const std::string& library : faces.libraries) colours.merge(diffuse_colours(folder / library));
  const Vec3 plain = object.materials[0].colour;
  const bool some_without = std::count(faces.material.begin(), faces.material.end(), -1) > 0;
  std::vector<ExportedMaterial> materials;
  if (some_without || faces.materials.empty()) materials.push_back(object.materials[0]);
  const int first = static_cast<int>(materials.size());
  for (const std::string& name : faces.materials) {
    const auto known = colours.find(name);
    materials.push_back({name, known == colours.end() ? plain : known->second});
  }
  object.materials = materials;
  object.face_material.clear();
  for (const int m : faces.material) object.face_material.push_back(m < 0 ? 0 : first + m);
}

}  // namespace

std::string take_source_faces(const Value& shape, ExportedObject& object) {
  std::vector<std::string> files;
  collect_files(shape, files);
  if (files.size() != 1 || !object.has_faces()) return "";
  const auto kept = [&](const std::string& why) {
    return fmt::format("object '{}' is written as triangles: {}", object.name, why);
  };
  FileFaces faces;
  std::error_code none;
  if (!fs::exists(files[0], none)) return kept(files[0] + " is not there any more");
  try {
    faces = read_file_faces(files[0]);
  } catch (const InputError& error) {
    return kept(error.what());
  }
  std::vector<Triangle> triangles;
  for (size_t c = 0; c + 2 < object.corners.size(); c += 3) triangles.push_back({object.corners[c], object.corners[c + 1], object.corners[c + 2]});
  const std::vector<Triangle> simulated = sorted(triangles, false);
  const bool same = simulated == sorted(faces.triangles, false), mirrored = !same && simulated == sorted(faces.triangles, true);
  if (faces.vertices != object.vertices || (!same && !mirrored)) return kept(fmt::format("{} has other triangles than what was simulated", files[0]));
  object.face_sizes = faces.sizes;
  object.corners = faces.corners;
  const bool mapped = !faces.corner_uvs.empty();
  if (mapped && std::count(faces.corner_uvs.begin(), faces.corner_uvs.end(), -1) == 0) {
    object.uvs = faces.uvs;
    object.corner_uvs = faces.corner_uvs;
  }
  take_materials(faces, fs::path(files[0]).parent_path(), object);
  if (mirrored) reverse_faces(object);
  if (mapped && object.corner_uvs.empty()) return fmt::format("object '{}' is written without texture coordinates: some corners of {} have none", object.name, files[0]);
  return "";
}

}  // namespace tack
