#include "framework/batch/case_state.hpp"

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

constexpr std::array<std::string_view, 9> names = {"waiting", "running", "done",      "expectation failed", "simulation failed",
                                                   "refused", "crashed", "timed out", "interrupted"};

}  // namespace

std::string_view to_string(CaseStatus status) { return names[static_cast<size_t>(status)]; }

bool finished(CaseStatus status) {
  return status != CaseStatus::waiting && status != CaseStatus::running && status != CaseStatus::interrupted;
}

bool failed(CaseStatus status) { return finished(status) && status != CaseStatus::done; }

CaseState read_case_state(const std::filesystem::path& path) {
  std::ifstream in(path);
  const nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object()) return {};
  try {
    const auto name = std::find(names.begin(), names.end(), json.at("status").get<std::string>());
    if (name == names.end()) return {};
    return {static_cast<CaseStatus>(name - names.begin()), json.at("digest"), json.at("error"),
            json.at("wall_seconds"), json.at("cpu_seconds"), json.at("memory_mb")};
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

void write_case_state(const std::filesystem::path& path, const CaseState& state) {
  const nlohmann::ordered_json json{{"status", to_string(state.status)},      {"digest", state.digest},
                                    {"error", state.error},                   {"wall_seconds", state.wall_seconds},
                                    {"cpu_seconds", state.cpu_seconds},       {"memory_mb", state.memory_mb}};
  replace_file(path, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace tack
