#include "framework/output/pvd.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <string_view>

#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

constexpr std::string_view head =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
    "  <Collection>\n";
constexpr std::string_view tail = "  </Collection>\n</VTKFile>\n";

constexpr std::array<std::pair<char, std::string_view>, 4> escapes = {
    {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}}};

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    std::string_view as(&c, 1);
    for (const auto& [plain, escape] : escapes) {
      if (c == plain) as = escape;
    }
    out += as;
  }
  return out;
}

std::string unescaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    char next = text.front();
    std::size_t length = 1;
    for (const auto& [plain, escape] : escapes) {
      if (!text.starts_with(escape)) continue;
      next = plain;
      length = escape.size();
    }
    out += next;
    text.remove_prefix(length);
  }
  return out;
}

std::optional<std::string_view> attribute(std::string_view line, std::string_view name) {
  const std::string opening = fmt::format(" {}=\"", name);
  const std::size_t begin = line.find(opening);
  if (begin == std::string_view::npos) return std::nullopt;
  const std::string_view rest = line.substr(begin + opening.size());
  const std::size_t length = rest.find('"');
  if (length == std::string_view::npos) return std::nullopt;
  return rest.substr(0, length);
}

}  // namespace

PvdFile PvdFile::continued(std::filesystem::path path, double last_time) {
  PvdFile list(std::move(path));
  std::ifstream in(list.path_);
  std::string line;
  while (std::getline(in, line)) {
    if (line.find("<DataSet") == std::string::npos) continue;
    const auto time_text = attribute(line, "timestep");
    const auto file = attribute(line, "file");
    double time = 0;
    const char* end = time_text ? time_text->data() + time_text->size() : nullptr;
    if (!file || !time_text || std::from_chars(time_text->data(), end, time).ptr != end) {
      throw InputError(
          fmt::format("{}: '{}' is not a frame of a run; start the run again instead of "
                      "resuming it",
                      list.path_.string(), line));
    }
    if (time <= last_time) list.entries_.push_back({time, unescaped(*file)});
  }
  return list;
}

void PvdFile::add(double time, const std::filesystem::path& frame) {
  entries_.push_back({time, frame.generic_string()});
  std::string text(head);
  for (const Frame& e : entries_) {
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", e.time,
                        escaped(e.file));
  }
  replace_file(path_, text.append(tail));
}

}  // namespace tack
