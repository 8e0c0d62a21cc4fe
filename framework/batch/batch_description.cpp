#include "framework/batch/batch_description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/batch/optional_json.hpp"
#include "framework/output/provenance_json.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const std::optional<Quantity>& bound) { return bound ? Json(bound->si) : Json(); }

std::optional<Quantity> bound_of(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return Quantity{json.get<double>(), ""};
}

Json json_of(const MeasuredData& d) {
  return {{"file", d.file}, {"x_column", d.x_column}, {"y_column", d.y_column}, {"from", json_of(d.from)}, {"to", json_of(d.to)},
          {"relative_to_peak", d.scale == DeviationScale::peak}};
}

MeasuredData data_of(const Json& json) {
  const DeviationScale scale = json.at("relative_to_peak") ? DeviationScale::peak : DeviationScale::point;
  return {json.at("file"), json.at("x_column"), json.at("y_column"), bound_of(json.at("from")), bound_of(json.at("to")), scale};
}

Json json_of(const BatchStatistic& s) {
  const StatisticQuery q = s.resolved();
  Json json{{"name", s.column()}, {"probe", q.probe}, {"statistic", to_string(q.statistic)}, {"along", q.along}, {"where", q.where}, {"over", q.over}};
  if (q.follows) json["follows"] = json_of(*q.follows);
  if (!s.stage.empty()) json["stage"] = s.stage;
  return json;
}

BatchStatistic statistic_of(const Json& json) {
  BatchStatistic s;
  s.name = json.at("name");
  s.query.probe = json.at("probe");
  s.query.along = json.at("along");
  s.query.where = json.at("where");
  s.query.over = json.at("over").get<std::vector<double>>();
  s.stage = json.value("stage", "");
  if (const auto follows = json.find("follows"); follows != json.end()) s.query.follows = data_of(*follows);
  for (const Statistic statistic : all_statistics)
    if (to_string(statistic) == json.at("statistic")) s.query.statistic = statistic;
  return s;
}

Json json_of(const BatchPlot& p) {
  Json json{{"name", p.name}, {"title", p.title}, {"x_label", p.x_label}, {"y_label", p.y_label}, {"x_range", p.x_range}, {"curves", Json::array()}, {"bars", p.bars},
            {"per", p.per}, {"bases", p.bases}, {"published", Json::array()}, {"source", p.source}};
  for (const auto& c : p.curves) json["curves"].push_back({{"base", c.base}, {"x", c.x}, {"y", c.y}, {"title", c.title}});
  for (const auto& n : p.published) json["published"].push_back({{"base", n.base}, {"value", n.value}});
  return json;
}

BatchPlot plot_of(const Json& json) {
  BatchPlot p;
  p.name = json.at("name");
  p.title = json.at("title");
  p.x_label = json.at("x_label");
  p.y_label = json.at("y_label");
  p.x_range = json.value("x_range", std::vector<double>());  // batches of 1.0.0 have none
  p.bars = json.at("bars");
  p.per = json.at("per");
  p.source = json.at("source");
  p.bases = json.at("bases").get<std::vector<std::string>>();
  for (const Json& c : json.at("curves")) p.curves.push_back({c.at("base"), c.at("x"), c.at("y"), c.at("title")});
  for (const Json& n : json.at("published")) p.published.push_back({n.at("base"), n.at("value")});
  return p;
}

Json json_of(const BatchPlan& plan, const BatchCase& one, const CaseState& state) {
  Json values = Json::object();
  for (const std::string& column : plan.columns)
    if (const auto found = one.values.find(column); found != one.values.end()) values[column] = found->second;
  return {{"name", one.name},     {"base", one.base},
          {"folder", "cases/" + one.name}, {"scene", "scenes/" + one.name + ".yaml"},
          {"values", values},     {"duration", one.duration},
          {"digest", one.digest}, {"status", to_string(state.status)},
          {"error", state.error}};
}

}  // namespace

std::string provenance_text(const Provenance& provenance) { return to_json(provenance).dump(-1, ' ', false, Json::error_handler_t::replace); }

CaseState state_of(const BatchFolder& folder, const BatchCase& one) {
  const CaseState state = read_case_state(folder.state(one.name));
  return state.digest == one.digest ? state : CaseState{};
}

std::vector<CaseState> states_of(const BatchFolder& folder, const BatchPlan& plan) {
  std::vector<CaseState> states;
  states.reserve(plan.cases.size());
  for (const BatchCase& one : plan.cases) states.push_back(state_of(folder, one));
  return states;
}

void write_description(const BatchFolder& folder, const BatchDescription& d, const std::vector<CaseState>& states) {
  Json json{{"name", d.plan.name}, {"about", d.plan.about}, {"file", d.file}, {"provenance", Json::parse(d.provenance)},
            {"threads", d.limits.threads}, {"jobs", d.limits.jobs}, {"memory", optional_json(d.limits.memory)},
            {"time_limit", optional_json(d.limits.time_limit)}, {"keys", d.plan.columns},
            {"units", d.plan.units}, {"table", d.table == BatchTable::hdf5 ? "hdf5" : "csv"}, {"statistics", Json::array()}, {"plots", Json::array()}, {"cases", Json::array()}};
  for (const BatchStatistic& s : d.plan.statistics) json["statistics"].push_back(json_of(s));
  for (const BatchPlot& p : d.plan.plots) json["plots"].push_back(json_of(p));
  for (size_t i = 0; i < d.plan.cases.size(); ++i) json["cases"].push_back(json_of(d.plan, d.plan.cases[i], states[i]));
  replace_file(folder.description(), json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

bool is_other_batch(const BatchFolder& folder, const BatchDescription& d) {
  BatchDescription there;
  try {
    there = read_description(folder);
  } catch (const InputError&) {
    return false;  // no description, or a damaged one, which will be rewritten
  }
  if (there.plan.name != d.plan.name) return true;
  if (there.file == d.file) return false;
  std::set<std::string> names;
  for (const BatchCase& one : there.plan.cases) names.insert(one.name);
  return std::none_of(d.plan.cases.begin(), d.plan.cases.end(), [&](const BatchCase& one) { return names.contains(one.name); });
}

BatchDescription read_description(const BatchFolder& folder) {
  const std::string path = folder.description();
  std::ifstream in(path);
  if (!in) throw InputError(fmt::format("{}: there is no such file; give the folder that `tack batch` made", path));
  try {
    const Json json = Json::parse(in);
    BatchDescription d;
    d.plan.name = json.at("name");
    d.plan.about = json.at("about");
    d.file = json.at("file");
    d.provenance = json.at("provenance").dump();
    d.limits = {json.at("threads"), json.at("jobs"), optional_number(json.at("memory")), optional_number(json.at("time_limit"))};
    d.plan.columns = json.at("keys").get<std::vector<std::string>>();
    if (json.contains("units")) d.plan.units = json["units"].get<std::map<std::string, std::string>>();
    if (json.value("table", "csv") == "hdf5") d.table = BatchTable::hdf5;
    for (const Json& s : json.at("statistics")) d.plan.statistics.push_back(statistic_of(s));
    for (const Json& p : json.value("plots", Json::array())) d.plan.plots.push_back(plot_of(p));
    for (const Json& c : json.at("cases")) {
      BatchCase one;
      one.name = c.at("name");
      one.base = c.at("base");
      one.values = c.at("values").get<std::map<std::string, std::string>>();
      one.digest = c.at("digest");
      one.duration = c.at("duration");
      d.plan.cases.push_back(std::move(one));
    }
    return d;
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: is damaged ({}); run the batch again, which keeps what is done", path, error.what()));
  }
}

}  // namespace tack
