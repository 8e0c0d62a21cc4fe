#include "framework/report/run_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/config/read_file.hpp"
#include "framework/output/recorded_status.hpp"
#include "framework/report/frame_series.hpp"
#include "framework/report/packing.hpp"
#include "framework/report/scene_data.hpp"
#include "framework/report/table_data.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int position_levels = 65535, field_levels = 1023;

// Returns the range of the finite values; {0, 0} if there are none.
Quantizer range_of(const std::vector<std::vector<float>>& frames, int levels) {
  Quantizer q{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), levels};
  for (const auto& frame : frames)
    for (const float number : frame)
      if (std::isfinite(number)) q.lowest = std::min(q.lowest, double(number)), q.highest = std::max(q.highest, double(number));
  if (!(q.lowest <= q.highest)) q.lowest = q.highest = 0;
  return q;
}

std::vector<std::vector<std::uint16_t>> codes_of(const std::vector<std::vector<float>>& frames, const Quantizer& q) {
  std::vector<std::vector<std::uint16_t>> codes;
  for (const auto& frame : frames) {
    auto& now = codes.emplace_back();
    for (const float number : frame) now.push_back(q.code(number));
  }
  return codes;
}

Json field_data(const FrameSeries::Field& field, PageData& page) {
  const Quantizer q = range_of(field.frames, field_levels);
  return {{"name", field.name},     {"unit", field.unit},     {"magnitude", field.magnitude}, {"of", field.of_vertices ? "vertices" : "elements"},
          {"lowest", q.lowest},     {"highest", q.highest},   {"levels", q.levels},
          {"block", page.add(delta_planes(codes_of(field.frames, q)))}};
}

}  // namespace

std::string number_bytes(const std::vector<int>& numbers) {
  return planes(std::span<const float>(std::vector<float>(numbers.begin(), numbers.end())));
}

Json frame_data(const FrameSeries& series, PageData& page, bool elements) {
  // One range for all directions, so that steps have one length.
  const Quantizer q = range_of(series.positions, position_levels);
  Json fields = Json::array();
  for (const auto& field : series.fields) fields.push_back(field_data(field, page));
  Json data = {{"times", series.times},
               {"written", series.written},
               {"origin", {series.origin.x(), series.origin.y(), series.origin.z()}},
               {"lowest", q.lowest},
               {"highest", q.highest},
               {"levels", q.levels},
               {"vertices", series.vertices()},
               {"positions", page.add(delta_planes(codes_of(series.positions, q)))},
               {"fields", std::move(fields)}};
  if (!elements) return data;
  data["triangles"] = page.add(number_bytes(series.triangles));
  data["edges"] = page.add(number_bytes(series.edges));
  data["points"] = page.add(number_bytes(series.points));
  data["object"] = page.add(number_bytes(series.object));
  return data;
}

Json run_data(const fs::path& folder, const std::string& label, int frames, PageData& page) {
  Json notes = Json::array();
  // Returns null if the file is missing, or unreadable, with a note then.
  const auto read_optional = [&](const char* file, const auto& read) -> Json {
    const fs::path path = folder / file;
    if (!fs::exists(path)) return Json();
    try {
      return read(path);
    } catch (const InputError& error) {
      notes.push_back(error.what());
    } catch (const Json::exception& error) {
      notes.push_back(fmt::format("{}: {}", path.string(), error.what()));
    }
    return Json();
  };
  Json summary = read_optional("summary.json", [](const fs::path& path) { return Json::parse(read_file(path, largest_text)); });
  Json scene = read_optional("scene.yaml", [](const fs::path& path) { return scene_data(path); });
  const auto numbers = [&](const fs::path& path) { return number_table(read_csv(path), page); };
  Json steps = read_optional("steps.csv", numbers), probes = read_optional("probes.csv", numbers);
  Json laws = read_optional("laws.csv", [](const fs::path& path) { return text_table(read_csv_texts(path)); });
  Json shown = read_optional("run.pvd", [&](const fs::path&) {
    const FrameSeries series = read_frames(folder, frames);
    for (const std::string& note : series.notes) notes.push_back(note);
    return series.times.empty() ? Json() : frame_data(series, page, true);
  });
  std::string status = recorded_status(summary);
  return {{"label", label},
          {"status", std::move(status)},
          {"notes", std::move(notes)},
          {"summary", std::move(summary)},
          {"scene", std::move(scene)},
          {"steps", std::move(steps)},
          {"probes", std::move(probes)},
          {"laws", std::move(laws)},
          {"frames", std::move(shown)}};
}

}  // namespace tack
