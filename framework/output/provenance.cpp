#include "framework/output/provenance.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "framework/output/build_info.hpp"
#include "framework/output/provenance_json.hpp"

namespace tack {
namespace {

std::string instruction_set() {
#if defined(__AVX512F__)
  std::string name = "AVX-512";
#elif defined(__AVX2__)
  std::string name = "AVX2";
#elif defined(__AVX__)
  std::string name = "AVX";
#elif defined(__SSE2__)
  std::string name = "SSE2";
#else
  std::string name = "none";
#endif
#if defined(__FMA__)
  name += ", FMA";
#endif
  return name;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

std::string quoted(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) || std::string_view("_-./=:,+@%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

std::string Build::revision() const {
  return commit.empty() || !(changed_sources || untracked_sources > 0) ? commit : commit + "-dirty";
}

std::string Build::sources() const {
  if (commit.empty()) return "no git checkout";
  std::string text = "commit " + commit;
  if (changed_sources) text += " with changed sources";
  if (untracked_sources > 0)
    text += fmt::format("{}{} untracked source file{}", changed_sources ? " and " : " with ", untracked_sources,
                        untracked_sources == 1 ? "" : "s");
  return text;
}

Build this_build() {
  return {TACK_VERSION, TACK_COMMIT, TACK_CHANGED_SOURCES == 1, TACK_UNTRACKED_SOURCES, TACK_COMPILER, TACK_FLAGS, instruction_set()};
}

std::string Machine::description() const {
  return fmt::format("{}, {} cores", cpu, cores > 0 ? cores : hardware_threads);
}

Machine this_machine() {
  Machine machine{host_name(), "an unknown processor", 0, static_cast<int>(std::thread::hardware_concurrency())};
  std::ifstream in("/proc/cpuinfo");
  std::set<std::pair<std::string, std::string>> cores;  // processor, core
  std::string line, processor;
  while (std::getline(in, line)) {
    const size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    const std::string value = line.substr(colon + 2);
    if (line.starts_with("model name")) machine.cpu = value;
    if (line.starts_with("physical id")) processor = value;
    if (line.starts_with("core id")) cores.emplace(processor, value);
  }
  machine.cores = static_cast<int>(cores.size());
  return machine;
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + quoted(word);
  return line;
}

Provenance provenance_of(const std::string& command_line, int threads) {
  std::error_code ignored;
  return {this_build(), this_machine(), threads, utc_now(), command_line, std::filesystem::current_path(ignored).string(), {}};
}

nlohmann::ordered_json to_json(const Provenance& p) {
  using Json = nlohmann::ordered_json;
  Json plugins = Json::array();
  for (const Plugin& plugin : p.plugins)
    plugins.push_back({{"path", plugin.path}, {"checksum", fmt::format("{:08x}", plugin.checksum)}});
  const bool known = !p.build.commit.empty();
  return {{"version", p.build.version},
          {"commit", p.build.commit},
          {"sources", p.build.sources()},
          {"changed_sources", known ? Json(p.build.changed_sources) : Json()},
          {"untracked_sources", known ? Json(p.build.untracked_sources) : Json()},
          {"compiler", p.build.compiler},
          {"flags", p.build.flags},
          {"instruction_set", p.build.instruction_set},
          {"date", p.date},
          {"host", p.machine.host},
          {"cpu", p.machine.cpu},
          {"cores", p.machine.cores},
          {"hardware_threads", p.machine.hardware_threads},
          {"threads", p.threads},
          {"command", p.command_line},
          {"directory", p.directory},
          {"plugins", plugins}};
}

}  // namespace tack
