// Sequences of mesh files, one per object and sample: OBJECT_000012.obj, .ply.
#include <bit>

#include "framework/export/draft_files.hpp"
#include "framework/export/obj_text.hpp"
#include "framework/export/ply_text.hpp"
#include "framework/export/shape_format.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

class MeshSequence : public ShapeFormat {
 public:
  void fields(Fields& f) override {
    ShapeFormat::fields(f);
    unit_.fields(f);
  }

 protected:
  explicit MeshSequence(const char* extension) : extension_(extension) {}
  virtual void append(fmt::memory_buffer& text, const ExportedObject& object, const std::vector<Vec3>& x, double scale) const = 0;
  virtual void begin(DraftFiles&, const fs::path&, const ExportedObject&) const {}

  std::string default_output(const std::string&) const override { return extension_; }
  void write_run(const RunShapes& run, const fs::path& folder, std::vector<std::string>& notes) const override {
    unit_.note_other_units(run, notes);
    for (const ExportedObject& object : run.objects()) {
      DraftFiles files;
      begin(files, folder, object);
      files.commit();
    }
    int last = -1;
    run.visit([&](int sample, const ObjectPositions& x) {
      last = sample;
      DraftFiles files;
      for (size_t k = 0; k < x.size(); ++k) {
        const ExportedObject& object = run.objects()[k];
        fmt::memory_buffer text;
        append(text, object, x[k], unit_.per_metre());
        files.append(files.begin(folder / fmt::format("{}_{:06}.{}", object.file_name, sample, extension_)), {text.data(), text.size()});
      }
      files.commit();
    });
    for (const ExportedObject& object : run.objects()) remove_after(last, folder, object.file_name);
  }

 private:
  // Removes the files of an object that an earlier, longer sequence left there: programs that read sequences would take them for its end.
  void remove_after(int last, const fs::path& folder, const std::string& name) const {
    std::vector<fs::path> stale;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string file = entry.path().filename();
      if (!file.starts_with(name + "_") || entry.path().extension() != "." + extension_) continue;
      const std::string number = entry.path().stem().string().substr(name.size() + 1);
      if (number.size() == 6 && number.find_first_not_of("0123456789") == number.npos && std::stoi(number) > last) stale.push_back(entry.path());
    }
    for (const fs::path& path : stale) fs::remove(path);
  }

  std::string extension_;
  OutputUnit unit_;
};

class ObjSequence : public MeshSequence {
 public:
  ObjSequence() : MeshSequence("obj") {}

 protected:
  void begin(DraftFiles& files, const fs::path& folder, const ExportedObject& object) const override {
    if (object.has_faces()) files.append(files.begin(folder / (object.file_name + ".mtl")), mtl_text(object));
  }
  void append(fmt::memory_buffer& text, const ExportedObject& object, const std::vector<Vec3>& x, double scale) const override {
    append_obj(text, object, x, scale, object.file_name + ".mtl");
  }
};
TACK_REGISTER(OutputFormat, ObjSequence, "obj", "A sequence of OBJ files, one per object and sample, with the polygons, texture coordinates and materials of the object's own file.", "");

class PlySequence : public MeshSequence {
 public:
  PlySequence() : MeshSequence("ply") {}

 protected:
  void append(fmt::memory_buffer& text, const ExportedObject& object, const std::vector<Vec3>& x, double scale) const override { append_ply(text, object, x, scale); }
};
TACK_REGISTER(OutputFormat, PlySequence, "ply", "A sequence of binary PLY files, one per object and sample, with double-precision coordinates and the polygons of the object's own file.", "");

}  // namespace
}  // namespace tack
