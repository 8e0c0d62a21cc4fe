// What a page says of a run's scene.yaml.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace tack {

// {name, about, text, up, objects [{name, radius}], probes [{column, type, unit, on, from, between}], expect [name]}. Throws InputError for a
// scene that this program does not know.
nlohmann::ordered_json scene_data(const std::filesystem::path& scene);

// The units of its probes, by column (output/probe_units.hpp).
std::map<std::string, std::string> probe_units(const std::filesystem::path& scene);

}  // namespace tack
