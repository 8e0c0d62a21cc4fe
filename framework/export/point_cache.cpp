// Point caches of objects, which Blender's modifier Mesh Cache plays on a mesh of equal vertices.
// Beside each cache, the object of the first sample is an .obj file.
//
// pc2 (little endian): "POINTCACHE2", version 1, number of points, start 0, sample rate 1, number of
// samples, then single-precision positions by sample.
// mdd (big endian): number of samples, number of points, times [s], then likewise.
#include <bit>
#include <cstdint>
#include <cstring>

#include "framework/export/draft_files.hpp"
#include "framework/export/obj_text.hpp"
#include "framework/export/shape_format.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little);

class Bytes {
 public:
  explicit Bytes(bool big_endian) : big_endian_(big_endian) {}
  void add(std::int32_t number) { add(std::bit_cast<std::uint32_t>(number)); }
  void add(float number) { add(std::bit_cast<std::uint32_t>(number)); }
  void add_text(std::string_view text) { content_ += text; }
  const std::string& content() const { return content_; }

 private:
  void add(std::uint32_t word) {
    if (big_endian_) word = __builtin_bswap32(word);
    char four[4];
    std::memcpy(four, &word, 4);
    content_.append(four, 4);
  }
  bool big_endian_;
  std::string content_;
};

class PointCache : public ShapeFormat {
 public:
  void fields(Fields& f) override {
    ShapeFormat::fields(f);
    unit_.fields(f);
  }

 protected:
  PointCache(const char* extension, bool big_endian) : extension_(extension), big_endian_(big_endian) {}
  virtual void add_header(Bytes& bytes, int vertices, const std::vector<double>& times) const = 0;

  std::string default_output(const std::string&) const override { return extension_; }
  void write_run(const RunShapes& run, const fs::path& folder, std::vector<std::string>& notes) const override {
    unit_.note_other_units(run, notes);
    DraftFiles files;
    std::vector<int> caches;
    for (const ExportedObject& object : run.objects()) {
      caches.push_back(files.begin(folder / (object.file_name + "." + extension_)));
      Bytes header(big_endian_);
      add_header(header, object.vertices, run.times());
      files.append(caches.back(), header.content());
    }
    const double scale = unit_.per_metre();
    run.visit([&](int sample, const ObjectPositions& x) {
      for (size_t k = 0; k < caches.size(); ++k) {
        if (sample == 0) write_mesh(files, folder, run.objects()[k], x[k]);
        Bytes points(big_endian_);
        for (const Vec3& p : x[k])
          for (const double c : p) points.add(static_cast<float>(scale * c));
        files.append(caches[k], points.content());
      }
    });
    files.commit();
  }

 private:
  void write_mesh(DraftFiles& files, const fs::path& folder, const ExportedObject& object, const std::vector<Vec3>& x) const {
    fmt::memory_buffer text;
    append_obj(text, object, x, unit_.per_metre(), object.file_name + ".mtl");
    files.append(files.begin(folder / (object.file_name + ".obj")), {text.data(), text.size()});
    if (object.has_faces()) files.append(files.begin(folder / (object.file_name + ".mtl")), mtl_text(object));
  }

  std::string extension_;
  bool big_endian_;
  OutputUnit unit_;
};

class Pc2Format : public PointCache {
 public:
  Pc2Format() : PointCache("pc2", false) {}

 protected:
  void add_header(Bytes& bytes, int vertices, const std::vector<double>& times) const override {
    bytes.add_text({"POINTCACHE2\0", 12});
    bytes.add(std::int32_t(1));
    bytes.add(std::int32_t(vertices));
    bytes.add(0.0F);
    bytes.add(1.0F);
    bytes.add(static_cast<std::int32_t>(times.size()));
  }
};
TACK_REGISTER(OutputFormat, Pc2Format, "pc2",
              "Point caches for Blender's modifier Mesh Cache: a folder with OBJECT.obj of the first sample and OBJECT.pc2 of all, vertices in the order of the "
              "object's own file.", "");

class MddFormat : public PointCache {
 public:
  MddFormat() : PointCache("mdd", true) {}

 protected:
  void add_header(Bytes& bytes, int vertices, const std::vector<double>& times) const override {
    bytes.add(static_cast<std::int32_t>(times.size()));
    bytes.add(std::int32_t(vertices));
    for (const double time : times) bytes.add(static_cast<float>(time));
  }
};
TACK_REGISTER(OutputFormat, MddFormat, "mdd", "Point caches as pc2, in the format of LightWave, with the time of each sample.", "");

}  // namespace
}  // namespace tack
