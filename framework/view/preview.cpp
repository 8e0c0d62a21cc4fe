#include "framework/view/preview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "framework/checks/bent_solids.hpp"
#include "framework/checks/law_check.hpp"
#include "framework/config/read_file.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/experiment/built_experiment.hpp"
#include "framework/experiment/retired_key_warnings.hpp"
#include "framework/output/frame_geometry.hpp"
#include "framework/report/run_data.hpp"
#include "framework/report/scene_data.hpp"
#include "framework/run/scene_warnings.hpp"
#include "framework/view/preview_motion.hpp"
#include "framework/view/preview_selections.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int frames_of_motions = 61;
constexpr size_t body_count_max = 300;  // bodies with a row of their own

struct Loaded {
  std::unique_ptr<BuiltExperiment> built;
  std::string error;  // why it cannot run
};

Loaded load(const PreviewSettings& s) {
  Loaded loaded;
  try {
    loaded.built = std::make_unique<BuiltExperiment>(load_experiment(s.file, s.overrides));
    probes_of(*loaded.built);
    return loaded;
  } catch (const InputError& error) {
    loaded.error = error.what();
    if (loaded.built) return loaded;
  }
  std::vector<std::string> without = s.overrides;
  without.push_back("contact=null");
  try {
    loaded.built = std::make_unique<BuiltExperiment>(load_experiment(s.file, without));
  } catch (const InputError&) {
    throw InputError(loaded.error);
  }
  return loaded;
}

FrameFile first_frame(const World& world) {
  FrameGeometry geometry = frame_geometry(world);
  FrameFile frame;
  frame.mesh.vertices.resize(static_cast<size_t>(geometry.vertices));
  frame.mesh.tets = std::move(geometry.tets);
  frame.mesh.triangles = std::move(geometry.triangles);
  frame.mesh.edges = std::move(geometry.edges);
  frame.mesh.points = std::move(geometry.points);
  frame.cell_arrays.push_back({"object", "", 1, Eigen::Map<const Eigen::VectorXi>(geometry.cell_object.data(), static_cast<Eigen::Index>(geometry.cell_object.size())).cast<double>()});
  return frame;
}

void set_positions(FrameFile& frame, const VecX& x) {
  for (size_t v = 0; v < frame.mesh.vertices.size(); ++v) frame.mesh.vertices[v] = x.segment<3>(3 * static_cast<Eigen::Index>(v));
}

// Returns the range of the laws between an object and all others beyond its surface [m]; null
// without adhesion.
Json adhesion_of(const World& world, int body, double contact_distance) {
  if (!world.contact || world.adhesion.empty()) return Json();
  const PairTable& pairs = world.contact->pairs();
  double range = 0;
  for (int other = 0; other < pairs.objects(); ++other) {
    const double offset = pairs.offset(body, other);
    for (const PairRole* role : {&pairs.point(body, other), &pairs.point(other, body), &pairs.codimensional(body, other)}) range = std::max(range, role->range_max() - offset);
  }
  return range > contact_distance * (1 + 1e-9) ? Json(range) : Json();
}

std::string prescribed_text(const World& world, const Body& body) {
  int prescribed = 0;
  for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) prescribed += world.prescribed_motion.ever_fixed(v);
  return prescribed == 0 ? "–" : prescribed == body.vertex_count ? (body.movable ? "all, for a while" : "all") : fmt::format("{} vertices", prescribed);
}

Json bodies_of(const Experiment& e, const World& world) {
  Json list = Json::array();
  for (size_t i = 0; i < std::min(body_count_max, world.bodies.size()); ++i) {
    const Body& body = world.bodies[i];
    Eigen::AlignedBox3d box;
    for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) box.extend(Vec3(world.start.x.segment<3>(3 * v)));
    const Vec3 extent = body.vertex_count > 0 ? Vec3(box.sizes()) : Vec3(Vec3::Zero());
    list.push_back({{"name", body.name}, {"vertices", body.vertex_count}, {"tets", body.tets.size()}, {"triangles", body.sheet.size()}, {"edges", body.edges.size()},
                    {"points", body.points.size()}, {"held", prescribed_text(world, body)}, {"extent", {extent.x(), extent.y(), extent.z()}},
                    {"contact", e.contact ? Json(e.contact->contact_distance) : Json()},
                    {"adhesion", e.contact ? adhesion_of(world, static_cast<int>(i), e.contact->contact_distance) : Json()}});
  }
  return list;
}

// Returns selections by the indices of shown vertices in the series.
Json selections_data(const std::vector<ShownSelection>& selections, const std::vector<int>& kept, size_t vertices, PageData& page) {
  std::vector<int> number(vertices, -1);
  for (size_t i = 0; i < kept.size(); ++i) number[static_cast<size_t>(kept[i])] = static_cast<int>(i);
  Json list = Json::array();
  for (const ShownSelection& selection : selections) {
    std::vector<int> shown;
    for (const int v : selection.vertices)
      if (static_cast<size_t>(v) < vertices && number[static_cast<size_t>(v)] >= 0) shown.push_back(number[static_cast<size_t>(v)]);
    list.push_back({{"name", selection.name}, {"count", selection.vertices.size()}, {"block", page.add(number_bytes(shown))}});
  }
  return list;
}

std::vector<std::string> notes_on(const Experiment& e, const World& world) {
  std::vector<std::string> notes = world.start_notes;
  for (const auto& lines : {BentSolids(e, world).notes(), check_laws(world).notes}) notes.insert(notes.end(), lines.begin(), lines.end());
  if (world.bodies.size() > body_count_max) notes.push_back(fmt::format("of {} objects, the first {} are in the table", world.bodies.size(), body_count_max));
  return notes;
}

std::vector<std::string> texts_of(const std::vector<Warning>& warnings) { return {warnings.begin(), warnings.end()}; }

}  // namespace

PageData preview_data(const PreviewSettings& s) {
  Loaded loaded = load(s);
  const Experiment& e = loaded.built->experiment();
  World& world = loaded.built->world();
  PageData page;

  FrameFile frame = first_frame(world);
  set_positions(frame, world.start.x);
  FrameSeriesBuilder follower(frame);
  const PrescribedFrames motion = prescribed_frames(world, e.time.duration, frames_of_motions);
  for (size_t i = 0; i < motion.times.size(); ++i) {
    set_positions(frame, motion.positions[i]);
    follower.add(motion.times[i], frame);
  }
  follower.series().written = static_cast<int>(motion.times.size());

  std::vector<Warning> warnings = retired_key_warnings(loaded.built->root(), e);
  for (Warning& warning : scene_warnings(e, world)) warnings.push_back(std::move(warning));
  std::vector<std::string> notes = notes_on(e, world);
  if (!motion.problem.empty()) notes.push_back(fmt::format("the motions are shown until t = {:g} s: {}", motion.times.back(), motion.problem));
  const Json selections = selections_data(shown_selections(loaded.built->root(), world), follower.kept(), frame.mesh.vertices.size(), page);
  page.document = {{"format", 1}, {"kind", "preview"}, {"title", e.name}, {"made", {{"version", s.version}, {"commit", s.commit}}}};
  page.document["preview"] = {{"error", loaded.error.empty() ? Json() : Json(loaded.error)}, {"warnings", texts_of(warnings)}, {"notes", notes},
                              {"duration", e.time.duration}, {"bodies", bodies_of(e, world)}};
  page.document["runs"] = Json::array();
  page.document["runs"].push_back({{"label", e.name.empty() ? fs::path(s.file).stem().string() : e.name}, {"status", "preview"}, {"notes", Json::array()}, {"summary", nullptr},
                                   {"scene", scene_data(e, loaded.built->root(), read_file(s.file, largest_text))}, {"steps", nullptr}, {"probes", nullptr}, {"laws", nullptr},
                                   {"frames", frame_data(follower.series(), page, true)}, {"selections", selections}});
  return page;
}

}  // namespace tack
