// What a page says of a run's scene.yaml.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace tack {

struct Experiment;
struct Value;

// {name, about, text, up, duration [s], objects [{name, radius [m], reach [m]}], probes [{column, type, unit, on, from, between}],
// expect [{name, unit, probe, along, wanted {target, tolerance, at_least, at_most}}]}; reach: of contact from its surface, half of where it begins, null without
// contact. Throws InputError for a scene that this program does not know.
nlohmann::ordered_json scene_data(const std::filesystem::path& scene);
// The same of one that is loaded; `root`: as parsed, `text`: as it is written.
nlohmann::ordered_json scene_data(const Experiment& experiment, const Value& root, const std::string& text);

// The units of its probes, by column (output/probe_units.hpp).
std::map<std::string, std::string> probe_units(const std::filesystem::path& scene);

}  // namespace tack
