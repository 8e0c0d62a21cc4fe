#include "framework/report/scene_data.hpp"

#include <cmath>

#include "framework/config/read_file.hpp"
#include "framework/experiment/drawn_scene.hpp"
#include "framework/experiment/load_experiment.hpp"
#include "framework/output/probe_units.hpp"
#include "framework/protocol/stage_metrics.hpp"
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

Json number_or_null(double number) { return std::isfinite(number) ? Json(number) : Json(); }

Json number_or_null(std::optional<double> number) { return number ? Json(*number) : Json(); }

Json json_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json probes_of(const Experiment& e, const Value& root) {
  Json list = Json::array();
  const Value* written = root.find("probes");
  for (size_t i = 0; i < e.probes.size(); ++i) {
    const Probe& probe = *e.probes[i];
    const Value& keys = written->items[i];
    for (const std::string& column : probe.columns())
      list.push_back({{"column", column}, {"type", json_of(keys.find("type"))}, {"unit", probe.unit().si}, {"on", json_of(keys.find("on"))},
                      {"from", json_of(keys.find("from"))}, {"between", json_of(keys.find("between"))}});
  }
  return list;
}

// Returns half of the contact range [m], so that contact begins where the ranges of two bodies
// meet.
Json contact_half_range(const ObjectConfig& object, const Experiment& e) {
  if (!e.contact) return Json();
  return object.contact_offset + e.contact->contact_distance / 2;
}

Json expectations_of(const Experiment& e) {
  std::map<std::string, Unit> units = {{"time", units::time}};
  ProbeSeries none{{"time"}, {}};
  for (const auto& probe : e.probes)
    for (const std::string& column : probe->columns()) {
      units[column] = probe->unit();
      none.columns.push_back(column);
    }
  Json list = Json::array();
  for (const Expectation& one : e.expect) {
    // The scene cannot be run.
    if (!units.contains(one.query.probe) || !units.contains(one.query.along)) continue;
    const ExpectationResult wanted = evaluate(one, none);
    list.push_back({{"name", wanted.name}, {"unit", unit_of(one.query.statistic, units[one.query.probe], units[one.query.along])},
                    {"probe", one.query.probe}, {"along", one.query.along},
                    {"wanted", {{"target", number_or_null(wanted.target)}, {"tolerance", number_or_null(wanted.tolerance)},
                                {"at_least", number_or_null(wanted.at_least)}, {"at_most", number_or_null(wanted.at_most)}}}});
  }
  return list;
}

}  // namespace

Json scene_data(const std::filesystem::path& scene) {
  const std::string text = read_file(scene, largest_text);
  const LoadedExperiment loaded = parse_experiment(text, scene.string());
  return scene_data(loaded.experiment, loaded.root, text);
}

Json scene_data(const Experiment& e, const Value& root, const std::string& text) {
  Json objects = Json::array();
  for (const ObjectConfig& object : e.objects) objects.push_back({{"name", object.name}, {"radius", number_or_null(drawn_radius(object))}, {"reach", contact_half_range(object, e)}});
  Json protocols = Json::array();
  for (const ProtocolConfig& protocol : e.protocols) {
    Json stages = Json::array();
    for (const StageConfig& stage : protocol.stages) stages.push_back(stage.name);
    protocols.push_back({{"name", protocol.name}, {"column", stage_metric(protocol, 0).name}, {"stages", std::move(stages)}});
  }
  return {{"name", e.name}, {"protocols", std::move(protocols)}, {"about", e.about}, {"text", text}, {"up", json_of(up_direction(e))}, {"duration", e.time.duration}, {"objects", std::move(objects)},
          {"probes", probes_of(e, root)}, {"expect", expectations_of(e)}};
}

std::map<std::string, std::string> probe_units(const std::filesystem::path& scene) {
  return probe_units(parse_experiment(read_file(scene, largest_text), scene.string()).experiment.probes);
}

}  // namespace tack
