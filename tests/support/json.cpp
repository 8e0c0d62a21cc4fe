#include "tests/support/json.hpp"

#include <fstream>

namespace tack {

nlohmann::json parse_json(const std::string& text) { return nlohmann::json::parse(text); }

nlohmann::json read_json(const std::filesystem::path& file) { return nlohmann::json::parse(std::ifstream(file)); }

}  // namespace tack
