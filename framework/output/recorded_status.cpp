#include "framework/output/recorded_status.hpp"

#include <fstream>

namespace tack {

std::string recorded_status(const nlohmann::ordered_json& summary) {
  if (!summary.is_object()) return unfinished_status;
  const auto status = summary.find("status");
  if (status == summary.end() || !status->is_string() || status->get_ref<const std::string&>().empty()) return unfinished_status;
  return status->get<std::string>();
}

std::string recorded_status(const std::filesystem::path& results) {
  std::ifstream in(results / "summary.json");
  return recorded_status(nlohmann::ordered_json::parse(in, nullptr, false));
}

}  // namespace tack
