// Page data of a run's scene.yaml.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace tack {

struct Experiment;
struct Value;

// Returns {name, protocols [{name, column of steps.csv, stages [name]}], about, text, up, duration
// [s], objects [{name, radius [m], reach [m]}], probes
// [{column, type, unit, on, from, between}], expect [{name, unit, probe, along, wanted {target,
// tolerance, at_least, at_most}}]}. reach: half of the contact range, from the object's surface;
// null without contact. Throws InputError for a scene that this program cannot read.
nlohmann::ordered_json scene_data(const std::filesystem::path& scene);
// Returns scene_data() of a loaded experiment. root: the parsed file; text: the file as written.
nlohmann::ordered_json scene_data(const Experiment& experiment, const Value& root,
                                  const std::string& text);

// Returns the units of the scene's probes by column (output/probe_units.hpp).
std::map<std::string, std::string> probe_units(const std::filesystem::path& scene);

}  // namespace tack
