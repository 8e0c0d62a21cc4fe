#include "framework/output/provenance.hpp"

#include <catch2/catch.hpp>
#include <regex>

#include "framework/output/provenance_json.hpp"
#include "tests/support/json.hpp"

using namespace tack;

namespace {

Build built(bool changed, int untracked) {
  Build build;
  build.commit = "abc";
  build.changed_sources = changed;
  build.untracked_sources = untracked;
  return build;
}

}  // namespace

TEST_CASE("a revision shows that sources differ from its commit") {
  CHECK(built(false, 0).revision() == "abc");
  CHECK(built(true, 0).revision() == "abc-dirty");
  CHECK(built(false, 1).revision() == "abc-dirty");
  CHECK(Build{}.revision() == "");
  CHECK(built(false, 0).sources() == "commit abc");
  CHECK(built(true, 0).sources() == "commit abc with changed sources");
  CHECK(built(false, 1).sources() == "commit abc with 1 untracked source file");
  CHECK(built(true, 2).sources() == "commit abc with changed sources and 2 untracked source files");
  CHECK(Build{}.sources() == "no git checkout");
}

TEST_CASE("provenance of a program has its build, machine and time") {
  const Provenance p = provenance_of("tack run a.yaml", 3);
  CHECK_FALSE(p.build.version.empty());
  CHECK(p.build.compiler.find('.') != std::string::npos);
  CHECK_FALSE(p.build.flags.empty());
  CHECK_FALSE(p.build.instruction_set.empty());
  CHECK_FALSE(p.machine.host.empty());
  CHECK_FALSE(p.machine.cpu.empty());
  CHECK(p.machine.hardware_threads >= 1);
  CHECK(p.threads == 3);
  CHECK(std::regex_match(p.date, std::regex("20\\d\\d-[01]\\d-[0-3]\\dT[0-2]\\d:[0-5]\\d:[0-6]\\dZ")));
  CHECK(p.command_line == "tack run a.yaml");
  CHECK(p.directory == std::filesystem::current_path().string());
}

TEST_CASE("provenance as JSON has exactly the documented keys, and null for unknown values") {
  Provenance p;
  std::vector<std::string> keys;
  const nlohmann::ordered_json unknown = to_json(p);
  for (const auto& [key, value] : unknown.items()) keys.push_back(key);
  CHECK(keys == std::vector<std::string>{"version", "commit", "sources", "changed_sources", "untracked_sources", "compiler",
                                         "flags", "instruction_set", "date", "host", "cpu", "cores", "hardware_threads",
                                         "threads", "command", "directory", "plugins"});
  CHECK(unknown["changed_sources"].is_null());
  CHECK(unknown["commit"] == "");
  CHECK(unknown["sources"] == "no git checkout");
  CHECK(unknown["plugins"].empty());
  p.plugins = {{"/a/libmine.so", 0x1f}};
  CHECK(to_json(p)["plugins"][0] == nlohmann::ordered_json({{"path", "/a/libmine.so"}, {"checksum", "0000001f"}}));
  p.build = built(true, 2);
  CHECK(to_json(p)["changed_sources"] == true);
  CHECK(to_json(p)["untracked_sources"] == 2);
}

TEST_CASE("a shell splits a recorded command line into the same words") {
  CHECK(shell_line({"tack", "run", "a.yaml"}) == "tack run a.yaml");
  CHECK(shell_line({"a b", "it's", "", "x=[1,2]"}) == "'a b' 'it'\\''s' '' 'x=[1,2]'");
  CHECK(shell_line({}) == "");
}
