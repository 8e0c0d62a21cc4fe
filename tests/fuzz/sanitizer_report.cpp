#include "tests/fuzz/sanitizer_report.hpp"

#include <algorithm>
#include <array>
#include <sstream>

namespace tack {
namespace {

constexpr const char *undefined = "runtime error:", *address = "ERROR: AddressSanitizer";

template <size_t N>
bool has_one_of(const std::string& text, const std::array<const char*, N>& parts) {
  return std::any_of(parts.begin(), parts.end(), [&](const char* part) { return text.find(part) != text.npos; });
}

// Identified by the first frame that is not of the sanitizer or a standard library: "    #1 0x7f421cbfcb89 in ... (/lib/libgmsh.so+0x5fcb89)".
bool within_mesh_library(const std::string& report) {
  std::istringstream lines(report);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("    #") && !has_one_of(line, std::array{"/libsanitizer/", "/libstdc++.", "/libc."}))
      return has_one_of(line, std::array{"/libgmsh.", "/libvtk"});
  return false;
}

bool out_of_memory(const std::string& report) {
  return has_one_of(report, std::array{"SUMMARY: AddressSanitizer: out-of-memory", "SUMMARY: AddressSanitizer: allocation-size-too-big"});
}

}  // namespace

bool has_sanitizer_report(const std::string& printed) { return has_one_of(printed, std::array{undefined, address}); }

bool has_report_of_ours(const std::string& printed) {
  if (printed.find(undefined) != printed.npos) return true;
  for (size_t at = printed.find(address), next; at != printed.npos; at = next) {
    next = printed.find(address, at + 1);
    const std::string report = printed.substr(at, next - at);
    if (!within_mesh_library(report) && !out_of_memory(report)) return true;
  }
  return false;
}

}  // namespace tack
