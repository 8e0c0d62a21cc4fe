// What a page says of a run's scene.yaml.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace tack {

// {name, about, text, up, objects [{name, radius}], probes [{column, type, unit, on, from, between}], expect [name]}. Throws InputError for a
// scene that this program does not know.
nlohmann::ordered_json scene_data(const std::filesystem::path& scene);

// {column: unit} of its probes.
nlohmann::ordered_json probe_units(const std::filesystem::path& scene);

}  // namespace tack
