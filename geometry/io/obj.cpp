// Wavefront .obj: v, f, l, p and the group names g and o; normals and smoothing are skipped, and
// texture coordinates and materials are read for file_faces.hpp alone. This reader keeps double
// precision and the order of vertices; VTK's reader has single precision and duplicates vertices
// per normal, CGAL's reads no lines.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "geometry/errors.hpp"
#include "geometry/io/formats.hpp"
#include "geometry/io/file_faces.hpp"
#include "geometry/io/polygon.hpp"
#include "geometry/io/printable.hpp"

namespace tack {
namespace {

constexpr std::string_view skipped[] = {"vn",     "vt",  "vp",       "s",        "usemtl", "mtllib",
                                        "usemap", "lod", "c_interp", "d_interp", "bevel",  "mg"};

std::vector<std::string_view> split(std::string_view line) {
  constexpr std::string_view blank = " \t\r";
  std::vector<std::string_view> words;
  std::size_t begin = line.find_first_not_of(blank);
  while (begin != line.npos) {
    const std::size_t end = std::min(line.find_first_of(blank, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blank, end);
  }
  return words;
}

class ObjReader {
 public:
  // faces: receives the polygons with their texture coordinates and materials; null: not wanted.
  explicit ObjReader(const std::filesystem::path& path, FileFaces* faces = nullptr)
      : path_(path.string()), file_(path), faces_(faces) {}

  Mesh read() {
    std::string text;
    while (next_line(text)) read_line(split(std::string_view(text).substr(0, text.find('#'))));
    for (auto& [name, group] : mesh_.tags) {
      std::sort(group.begin(), group.end());
      group.erase(std::unique(group.begin(), group.end()), group.end());
    }
    return std::move(mesh_);
  }

 private:
  // Reads a statement. A backslash at the end of a line continues it.
  bool next_line(std::string& text) {
    text.clear();
    std::string part;
    while (std::getline(file_, part)) {
      ++line_;
      if (!part.empty() && part.back() == '\r') part.pop_back();
      text += part;
      if (text.empty() || text.back() != '\\') return true;
      text.back() = ' ';
    }
    return !text.empty();
  }

  void read_line(const std::vector<std::string_view>& words) {
    if (words.empty()) return;
    const std::string_view key = words[0];
    if (key == "v") return read_vertex(words);
    if (key == "f") return read_face(words);
    if (key == "l") return read_line_element(words);
    if (key == "p") return read_points(words);
    if (key == "g" || key == "o") {
      groups_.assign(words.begin() + 1, words.end());
      return;
    }
    if (faces_ && key == "vt") return read_texture_coordinates(words);
    if (faces_ && key == "usemtl") return use_material(words);
    if (faces_ && key == "mtllib") {
      faces_->libraries.insert(faces_->libraries.end(), words.begin() + 1, words.end());
      return;
    }
    if (std::find(std::begin(skipped), std::end(skipped), key) != std::end(skipped)) return;
    fail(fmt::format("\"{}\" is no statement of an .obj mesh: give v, f, l, p, g or o",
                     printable(key)));
  }

  void read_vertex(const std::vector<std::string_view>& words) {
    // Further numbers are a weight or a colour.
    if (words.size() < 4) fail("a vertex needs three coordinates");
    Vec3 x;
    for (int i = 0; i < 3; ++i) x[i] = number(words[i + 1]);
    mesh_.vertices.push_back(x);
  }

  void read_face(const std::vector<std::string_view>& words) {
    const std::vector<int> corners = indices(words);
    add_polygon(mesh_, corners, where());
    if (!faces_) return;
    faces_->sizes.push_back(static_cast<int>(corners.size()));
    faces_->corners.insert(faces_->corners.end(), corners.begin(), corners.end());
    for (std::size_t w = 1; w < words.size(); ++w) faces_->corner_uvs.push_back(texture_index(words[w]));
    faces_->material.push_back(material_);
  }

  void read_texture_coordinates(const std::vector<std::string_view>& words) {
    if (words.size() < 2) fail("texture coordinates need a number");
    faces_->uvs.emplace_back(number(words[1]), words.size() > 2 ? number(words[2]) : 0);
  }

  // Returns t of "i/t" or "i/t/n", from 0; -1: none.
  int texture_index(std::string_view corner) const {
    const std::size_t begin = corner.find('/');
    if (begin == corner.npos) return -1;
    const std::string_view text = corner.substr(begin + 1, corner.find('/', begin + 1) - begin - 1);
    if (text.empty()) return -1;
    int i = 0;
    const int count = static_cast<int>(faces_->uvs.size());
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), i);
    if (error != std::errc() || end != text.data() + text.size() || i == 0 || i > count || i < -count)
      fail(fmt::format("\"{}\" refers to no texture coordinates above it", printable(corner)));
    return i > 0 ? i - 1 : count + i;
  }

  void use_material(const std::vector<std::string_view>& words) {
    const std::string name(words.size() > 1 ? words[1] : "");
    const auto found = std::find(faces_->materials.begin(), faces_->materials.end(), name);
    material_ = static_cast<int>(found - faces_->materials.begin());
    if (found == faces_->materials.end()) faces_->materials.push_back(name);
  }

  void read_line_element(const std::vector<std::string_view>& words) {
    const std::vector<int> line = indices(words);
    if (line.size() < 2) fail("a line needs at least two vertices");
    for (std::size_t i = 0; i + 1 < line.size(); ++i) mesh_.edges.push_back({line[i], line[i + 1]});
  }

  void read_points(const std::vector<std::string_view>& words) {
    for (int v : indices(words)) mesh_.points.push_back(v);
  }

  // Reads indices "i", "i/t", "i//n" or "i/t/n": from 1, or negative, counted back from the last vertex.
  std::vector<int> indices(const std::vector<std::string_view>& words) {
    const int count = static_cast<int>(mesh_.vertices.size());
    std::vector<int> result;
    for (std::size_t w = 1; w < words.size(); ++w) {
      const std::string_view text = words[w].substr(0, words[w].find('/'));
      int i = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), i);
      if (error != std::errc() || end != text.data() + text.size()) {
        fail(fmt::format("\"{}\" is no vertex number", printable(words[w])));
      }
      if (i == 0 || i > count || i < -count) {
        fail(fmt::format("refers to vertex {} of {} (counted from 1): define it before its use, or "
                         "correct the number",
                         i, count));
      }
      result.push_back(i > 0 ? i - 1 : count + i);
    }
    for (const std::string& group : groups_) {
      auto& tag = mesh_.tags[group];
      tag.insert(tag.end(), result.begin(), result.end());
    }
    return result;
  }

  double number(std::string_view text) const {
    const std::string_view digits = text.substr(text[0] == '+' ? 1 : 0);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) {
      fail(fmt::format("\"{}\" is no finite number", printable(text)));
    }
    return value;
  }

  std::string where() const { return fmt::format("{}:{}", path_, line_); }

  [[noreturn]] void fail(const std::string& what) const { throw InputError(where() + ": " + what); }

  std::string path_;
  std::ifstream file_;
  int line_ = 0;
  int material_ = -1;  // of the next faces; -1: none
  std::vector<std::string> groups_;
  Mesh mesh_;
  FileFaces* faces_;
};

}  // namespace

Mesh read_obj(const std::filesystem::path& path) { return ObjReader(path).read(); }

FileFaces read_obj_faces(const std::filesystem::path& path) {
  FileFaces faces;
  const Mesh mesh = ObjReader(path, &faces).read();
  faces.vertices = static_cast<int>(mesh.vertices.size());
  faces.triangles = mesh.triangles;
  if (std::all_of(faces.corner_uvs.begin(), faces.corner_uvs.end(), [](int uv) { return uv < 0; })) faces.corner_uvs.clear();
  return faces;
}

}  // namespace tack
