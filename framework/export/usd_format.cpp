// USD as text (.usda) with a time sample of the points for each sample of the run.
// Universal Scene Description, https://openusd.org: schemas UsdGeomMesh, UsdGeomBasisCurves and
// UsdGeomPoints.
#include <set>

#include "framework/export/draft_files.hpp"
#include "framework/export/shape_format.hpp"
#include "framework/export/usd_prim.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

// A prim that is being written: points and extents go to drafts, because a file holds all samples of
// one attribute before those of the next. A prim that never moves has no samples.
struct OpenPrim {
  UsdPrim prim;
  int object = 0;               // index in the run
  int points = 0, extents = 0;  // drafts
  std::string first_points, first_extent;
  bool moves = false;
};

class UsdFormat : public ShapeFormat {
 public:
  void fields(Fields& f) override {
    ShapeFormat::fields(f);
    unit_.fields(f);
  }

 protected:
  std::string default_output(const std::string& run) const override { return run + ".usda"; }
  bool writes_one_file() const override { return true; }
  void check_output(const fs::path& path) const override {
    if (path.extension() != ".usda") throw InputError(fmt::format("{}: names of USD files as text end in .usda; give one with -o", path.string()));
  }

  void write_run(const RunShapes& run, const fs::path& path, std::vector<std::string>& notes) const override {
    DraftFiles files;
    const int file = files.begin(path);
    const double scale = unit_.per_metre();
    std::vector<OpenPrim> prims;
    std::set<std::string> taken;
    for (size_t k = 0; k < run.objects().size(); ++k) {
      const ExportedObject& object = run.objects()[k];
      std::string name = usd_identifier(object.file_name);
      while (!taken.insert(name).second) name += "_";
      for (UsdPrim& prim : usd_prims(object, name, scale)) {
        taken.insert(prim.name);
        const std::string draft = path.string() + "." + prim.name;
        const int points = files.begin(draft + ".points"), extents = files.begin(draft + ".extents");
        prims.push_back({std::move(prim), static_cast<int>(k), points, extents, "", ""});
      }
    }
    const double rate = run.rate();
    run.visit([&](int sample, const ObjectPositions& x) {
      for (OpenPrim& open : prims) {
        const std::string time = fmt::format("{:.9g}", rate * run.times()[sample]);
        fmt::memory_buffer points, extent;
        append_points(points, open.prim.vertices, x[open.object], scale);
        append_extent(extent, open.prim, x[open.object], scale);
        if (sample == 0) {
          open.first_points = fmt::to_string(points);
          open.first_extent = fmt::to_string(extent);
        }
        open.moves = open.moves || std::string_view(points.data(), points.size()) != open.first_points;
        files.append(open.points, sample_text(time, points));
        files.append(open.extents, sample_text(time, extent));
      }
    });
    files.append(file, header(run, notes));
    for (const OpenPrim& open : prims) {
      files.append(file, fmt::format("\n    def {} \"{}\"\n    {{\n", open.prim.type, open.prim.name));
      append_samples(files, file, "float3[] extent", open.moves, open.first_extent, open.extents);
      append_samples(files, file, "point3f[] points", open.moves, open.first_points, open.points);
      files.append(file, open.prim.properties + "    }\n");
    }
    files.append(file, "}\n");
    files.commit();
  }

 private:
  static std::string sample_text(const std::string& time, const fmt::memory_buffer& value) {
    return fmt::format("            {}: {},\n", time, std::string_view(value.data(), value.size()));
  }

  static void append_samples(DraftFiles& files, int file, const char* attribute, bool moves, const std::string& first, int samples) {
    files.append(file, moves ? fmt::format("        {}.timeSamples = {{\n", attribute) : fmt::format("        {} = {}\n", attribute, first));
    if (moves) files.append_draft(file, samples);
    else files.drop(samples);
    if (moves) files.append(file, "        }\n");
  }

  std::string header(const RunShapes& run, std::vector<std::string>& notes) const {
    const Vec3 up = run.up();
    const char axis = std::abs(up.z()) > std::abs(up.y()) ? 'Z' : 'Y';
    if (up[axis - 'X'] < 1 - 1e-6) notes.push_back(fmt::format("upAxis of the file is {0}, because USD knows y and z alone; up in the scene, against gravity, is ({1:.3g}, {2:.3g}, {3:.3g})", axis, up.x(), up.y(), up.z()));
    const std::string root = usd_identifier(run.name());
    return fmt::format("#usda 1.0\n(\n    defaultPrim = \"{0}\"\n    endTimeCode = {1:.9g}\n    framesPerSecond = {2:.9g}\n    metersPerUnit = {3:.9g}\n    startTimeCode = {4:.9g}\n"
                       "    timeCodesPerSecond = {2:.9g}\n    upAxis = \"{5}\"\n)\n\ndef Xform \"{0}\"\n{{",
                       root, run.rate() * run.times().back(), run.rate(), 1 / unit_.per_metre(), run.rate() * run.times().front(), axis);
  }

  OutputUnit unit_;
};
TACK_REGISTER(OutputFormat, UsdFormat, "usd",
              "One USD file as text (.usda) for Houdini, Omniverse and others: a Mesh per object with polygons, texture coordinates and colours, rods as BasisCurves, "
              "particles as Points, with time samples.", "");

}  // namespace
}  // namespace tack
