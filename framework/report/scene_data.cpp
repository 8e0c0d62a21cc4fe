#include "framework/report/scene_data.hpp"

#include "framework/body/rod_section.hpp"
#include "framework/config/read_file.hpp"
#include "framework/experiment/load_experiment.hpp"
#include "framework/output/probe_units.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Value* value) {
  if (!value || value->is_null()) return Json();
  if (value->is_scalar()) return Json(value->text);
  Json list = Json::array();
  for (const Value& item : value->items) list.push_back(json_of(&item));
  return list;
}

// How thick edges and points are drawn [m]; null: nobody says.
Json radius_of(const ObjectConfig& object) {
  if (object.rod) return object.rod->section().contact_width() / 2;
  if (object.particle) return object.particle->radius;
  return Json();
}

// Against gravity; without it, y.
Json up_of(const Experiment& e) {
  const Vec3 up = e.gravity.norm() > 0 ? Vec3(-e.gravity.normalized()) : Vec3::UnitY();
  return {up.x(), up.y(), up.z()};
}

Json probes_of(const LoadedExperiment& loaded) {
  Json list = Json::array();
  const Value* written = loaded.root.find("probes");
  for (size_t i = 0; i < loaded.experiment.probes.size(); ++i) {
    const Probe& probe = *loaded.experiment.probes[i];
    const Value& keys = written->items[i];
    for (const std::string& column : probe.columns())
      list.push_back({{"column", column}, {"type", json_of(keys.find("type"))}, {"unit", probe.unit().si}, {"on", json_of(keys.find("on"))},
                      {"from", json_of(keys.find("from"))}, {"between", json_of(keys.find("between"))}});
  }
  return list;
}

}  // namespace

Json scene_data(const std::filesystem::path& scene) {
  const std::string text = read_file(scene, largest_text);
  const LoadedExperiment loaded = parse_experiment(text, scene.string());
  const Experiment& e = loaded.experiment;
  Json objects = Json::array(), expect = Json::array();
  for (const ObjectConfig& object : e.objects) objects.push_back({{"name", object.name}, {"radius", radius_of(object)}});
  for (const Expectation& one : e.expect) expect.push_back(name_of(one));
  return {{"name", e.name}, {"about", e.about}, {"text", text}, {"up", up_of(e)}, {"objects", std::move(objects)}, {"probes", probes_of(loaded)},
          {"expect", std::move(expect)}};
}

std::map<std::string, std::string> probe_units(const std::filesystem::path& scene) {
  return probe_units(parse_experiment(read_file(scene, largest_text), scene.string()).experiment.probes);
}

}  // namespace tack
