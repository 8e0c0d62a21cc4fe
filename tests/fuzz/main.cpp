// tack_fuzz KIND COUNT [SEED [FIRST]]: damages COUNT files (KIND: meshes, scenes, states) and has the program read
// them. Every one must end by itself within a minute of processor time and with a documented exit code: 0, 1, 2 or 3, and 2 for a
// stored state. Those that do not are kept in the folder tack_fuzz_failures of the working directory; the same
// KIND, SEED and number (FIRST, with COUNT 1) give the same damage again.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>

#include "tests/fuzz/corpus.hpp"
#include "tests/fuzz/forked_run.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/fuzz/sanitizer_report.hpp"
#include "tests/support/program.hpp"
#include "tests/support/silence.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr double limit = 60;  // s of processor time for each

// Returns the fault of the end of a run; "" if it ended well.
std::string fault(const ForkedResult& result, const Sample& sample, bool damaged) {
  if (result.hung) return fmt::format("took more than {} s of processor time", limit);
  if (result.signal != 0) return fmt::format("ended by signal {}", result.signal);
  if (result.exit_code < 0 || result.exit_code > 3) return fmt::format("ended with {}", result.exit_code);
  if (result.printed.find("internal error") != std::string::npos) return "ended with an internal error";
  const bool refused = result.exit_code == 2;  // whatever happened to the fork that read it
  if (refused ? has_report_of_ours(result.printed) : has_sanitizer_report(result.printed)) return "was stopped by a sanitizer";
  if (sample.must_refuse && damaged && result.exit_code != 2)
    return fmt::format("did not refuse it, but ended with {}", result.exit_code);
  return "";
}

std::string keep(const Sample& sample, const std::string& text, const ForkedResult& result, const std::string& name) {
  const fs::path folder = fs::path("tack_fuzz_failures") / name;
  fs::create_directories(folder);
  write_file(folder / sample.path.filename(), text);
  write_file(folder / "printed.txt", result.printed);
  return fs::absolute(folder).string();
}

int fuzz(const std::string& kind, int count, unsigned long seed, int first) {
  const TemporaryFolder scratch;
  const std::vector<Sample> samples = corpus(kind, scratch.path());
  std::map<int, int> codes;
  int faults = 0;
  for (int i = first; i < first + count; ++i) {
    std::mt19937_64 random(seed * 1'000'003 + static_cast<unsigned long>(i));
    const size_t turn = static_cast<size_t>(i);
    const Sample& sample = samples[turn % samples.size()];
    const auto& command = sample.commands[turn / samples.size() % sample.commands.size()];
    const std::string text = mutated(sample.content, random);
    write_file(sample.path, text);
    const ForkedResult result = run_forked(sample.directory, command, limit);
    write_file(sample.path, sample.content);
    ++codes[result.exit_code];
    for (const char* written : {"results", "compared"})  // moved aside by the next, again and again
      if (!sample.must_refuse) fs::remove_all(scratch.path() / written);
    const std::string wrong = fault(result, sample, text != sample.content);
    if (wrong.empty()) continue;
    ++faults;
    fmt::print("{} {} of seed {} ({} {}): {}; kept in {}\n", kind, i, seed, command[0], sample.path.filename().string(),
               wrong, keep(sample, text, result, fmt::format("{}_{}_{}", kind, seed, i)));
    std::fflush(stdout);
  }
  std::string ends;
  for (const auto& [code, times] : codes) ends += fmt::format(" {} x {}", times, code);
  fmt::print("{} {}: exit codes{}\n{} passed, {} failed\n", count, kind, ends, count - faults, faults);
  return faults == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace tack

int main(int argc, char** argv) {
  if (argc < 3 || argc > 5) {
    fmt::print(stderr, "usage: tack_fuzz meshes|scenes|states COUNT [SEED [FIRST]]\n");
    return 2;
  }
  try {
    return tack::fuzz(argv[1], std::atoi(argv[2]), argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 1,
                      argc > 4 ? std::atoi(argv[4]) : 0);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
