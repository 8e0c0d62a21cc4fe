// The files that a scene names, and their digests.
#include "framework/config/file_digest.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/config/parse.hpp"
#include "geometry/io/replace_file.hpp"
#include "tests/support/program.hpp"

using namespace tack;

TEST_CASE("files of a scene are found wherever it names them, each once", "[config]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.path() / "mesh", data = folder.path() / "data.csv", run = folder.path() / "run.state";
  for (const std::string& path : {mesh, data, run}) replace_file(path, "123456789");
  const Value scene = parse_string(fmt::format("objects: [{{shape: {{path: {0}}}}}, {{shape: {{path: {0}}}}}]\n"
                                             "expect: [{{follows: {1}}}, {{follows: none.csv}}, {{follows: /nowhere/none.csv}}]\nstart: {2}\n",
                                             mesh, data, run),
                                 "scene.yaml");
  CHECK(named_paths(scene) == std::vector<std::string>{mesh, data, "/nowhere/none.csv", run});
  // "123456789" has the check value of CRC-32.
  CHECK(file_digests(scene) == std::map<std::string, std::string>{{mesh, "9-cbf43926"}, {data, "9-cbf43926"}});
}
