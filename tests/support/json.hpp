// JSON values for tests. Parsing is instantiated once: it is slow to compile.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace tack {

nlohmann::json parse_json(const std::string& text);
nlohmann::json read_json(const std::filesystem::path& file);

}  // namespace tack
