#include "geometry/io/gltf.hpp"

#include <fmt/format.h>
#include <vtkCompositeDataIterator.h>
#include <vtkDataSet.h>
#include <vtkGLTFReader.h>
#include <vtkMultiBlockDataSet.h>

#include <cstdint>
#include <cstring>
#include <map>

#include "geometry/errors.hpp"
#include "geometry/io/formats.hpp"
#include "geometry/io/precheck.hpp"
#include "geometry/io/printable.hpp"
#include "geometry/io/quiet_vtk.hpp"
#include "geometry/io/vtk_cells.hpp"
#include "geometry/mesh/cleanup.hpp"

namespace tack {
namespace {

using Single = std::array<float, 3>;

Single single(const Vec3& x) { return {static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(x.z())}; }

// Binary data and their JSON description. Codes of the format: component types 5126 float, 5125 unsigned integer; targets 34962 vertices,
// 34963 indices; modes 0 points, 1 lines, 4 triangles.
class Document {
 public:
  explicit Document(const Mesh& mesh) {
    Eigen::AlignedBox3f box;
    for (const Vec3& x : mesh.vertices) {
      const Single at = single(x);
      box.extend(Eigen::Map<const Eigen::Vector3f>(at.data()));
      append(at.data(), sizeof at);
    }
    const auto& low = box.min();
    const auto& high = box.max();
    view(34962);
    accessors_ = fmt::format(R"({{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3","min":[{},{},{}],"max":[{},{},{}]}})", mesh.vertices.size(), low.x(),
                             low.y(), low.z(), high.x(), high.y(), high.z());
    elements(4, mesh.triangles);
    elements(1, mesh.edges);
    std::vector<std::array<int, 1>> points;
    for (const int v : mesh.points) points.push_back({v});
    elements(0, points);
  }

  const std::string& data() const { return data_; }
  // uri: JSON member with the data; "" in a .glb.
  std::string json(const std::string& uri) const {
    return fmt::format(R"({{"asset":{{"version":"2.0","generator":"tack"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],)"
                       R"("meshes":[{{"primitives":[{}]}}],"accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{}{}}}]}})",
                       primitives_, accessors_, views_, data_.size(), uri);
  }

 private:
  void append(const void* bytes, std::size_t size) { data_.append(static_cast<const char*>(bytes), size); }

  // Adds a buffer view of the bytes appended since the last one.
  void view(int target) {
    views_ += fmt::format(R"({}{{"buffer":0,"byteOffset":{},"byteLength":{},"target":{}}})", views_.empty() ? "" : ",", begin_, data_.size() - begin_, target);
    begin_ = data_.size();
    ++view_count_;
  }

  template <std::size_t N>
  void elements(int mode, const std::vector<std::array<int, N>>& list) {
    if (list.empty()) return;
    for (const std::array<int, N>& element : list)
      for (const int v : element) {
        const auto index = static_cast<std::uint32_t>(v);
        append(&index, sizeof index);
      }
    primitives_ += fmt::format(R"({}{{"attributes":{{"POSITION":0}},"indices":{},"mode":{}}})", primitives_.empty() ? "" : ",", view_count_, mode);
    accessors_ += fmt::format(R"(,{{"bufferView":{},"componentType":5125,"count":{},"type":"SCALAR"}})", view_count_, N * list.size());
    view(34963);
  }

  std::string data_, views_, accessors_, primitives_;
  std::size_t begin_ = 0;
  int view_count_ = 0;
};

std::string base64(const std::string& data) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < data.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < data.size() ? static_cast<unsigned char>(data[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= data.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

void add_number(std::string& bytes, std::uint32_t number) { bytes.append(reinterpret_cast<const char*>(&number), sizeof number); }

void add_chunk(std::string& bytes, const char (&kind)[5], std::string content, char filler) {
  content.append((4 - content.size() % 4) % 4, filler);
  add_number(bytes, static_cast<std::uint32_t>(content.size()));
  bytes.append(kind, 4);
  bytes += content;
}

}  // namespace

std::string glb_bytes(const Mesh& mesh) {
  const Document document(mesh);
  std::string chunks;
  add_chunk(chunks, "JSON", document.json(""), ' ');
  add_chunk(chunks, "BIN\0", document.data(), '\0');
  std::string bytes = "glTF";
  add_number(bytes, 2);
  add_number(bytes, static_cast<std::uint32_t>(12 + chunks.size()));
  return bytes + chunks;
}

std::string gltf_text(const Mesh& mesh) {
  const Document document(mesh);
  return document.json(R"(,"uri":"data:application/octet-stream;base64,)" + base64(document.data()) + "\"");
}

std::array<int, 2> merged_in_single_precision(const Mesh& mesh) {
  std::map<Single, int> first;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto [at, is_new] = first.try_emplace(single(mesh.vertices[v]), static_cast<int>(v));
    if (!is_new && mesh.vertices[at->second] != mesh.vertices[v]) return {at->second, static_cast<int>(v)};
  }
  return {-1, -1};
}

Mesh read_gltf(const std::filesystem::path& path) {
  const std::string name = path.string();
  precheck_gltf(name);
  vtkNew<vtkGLTFReader> reader;
  QuietVtk quiet;
  reader->SetFileName(name.c_str());
  reader->Update();
  vtkMultiBlockDataSet* scene = reader->GetOutput();
  if (const std::string message = quiet.first_message(); !scene || !message.empty() || reader->GetErrorCode() != 0)
    throw InputError(fmt::format("{}: not a valid file of its format{}: export it again, or as one of .obj .ply .off .stl", name,
                                 message.empty() ? "" : " (" + printable(message, 200) + ")"));
  Mesh mesh;
  const auto blocks = vtkSmartPointer<vtkCompositeDataIterator>::Take(scene->NewIterator());
  for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
    if (auto* block = vtkDataSet::SafeDownCast(blocks->GetCurrentDataObject())) append(mesh, mesh_of(*block, name));
  // Blocks have their own vertices, and vertices are repeated for each normal and colour.
  merge_duplicate_vertices(mesh);
  drop_unused_vertices(mesh);
  if (mesh.vertices.empty()) throw InputError(name + ": no geometry found in its scene; is it compressed (Draco)? Export it again without");
  return mesh;
}

}  // namespace tack
