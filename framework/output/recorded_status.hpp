// The status of a run, as its results folder tells it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace tack {

// Status of a run that has no readable summary.json: it goes on, or was killed.
inline constexpr const char* unfinished_status = "unfinished";

// Returns "status" of a parsed summary.json (RunStatus as text); unfinished_status if it has none.
std::string recorded_status(const nlohmann::ordered_json& summary);

// Returns the status of the run in a results folder.
std::string recorded_status(const std::filesystem::path& results);

}  // namespace tack
