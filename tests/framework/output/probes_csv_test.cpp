#include "framework/output/probes_csv.hpp"

#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "tests/support/silence.hpp"

using namespace tack;

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("probes.csv holds the time and a column per value, and keeps the series") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "probes.csv";
  ProbesCsv probes(path, {"gap", "force_x"});
  CHECK(text_of(path) == "time,gap,force_x\n");
  probes.add(0.5, {1, -2.5});
  probes.add(1, {3, 1e-9});
  CHECK(text_of(path) == "time,gap,force_x\n0.5,1,-2.5\n1,3,1e-09\n");
  CHECK(probes.series().columns == std::vector<std::string>{"time", "gap", "force_x"});
  CHECK(probes.series().rows == std::vector<std::vector<double>>{{0.5, 1, -2.5}, {1, 3, 1e-9}});
  CHECK_THROWS_AS(probes.add(2, {1}), std::logic_error);
  CHECK(probes.series().rows.size() == 2);
}

TEST_CASE("probes.csv is continued from a given time") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "probes.csv";
  std::ofstream(path) << "time,gap\n0.5,1\n1,2\n1.5,";
  ProbesCsv probes = ProbesCsv::continued(path, {"gap"}, 0.5);
  probes.add(0.75, {9});
  CHECK(text_of(path) == "time,gap\n0.5,1\n0.75,9\n");
  CHECK(probes.series().rows == std::vector<std::vector<double>>{{0.5, 1}, {0.75, 9}});
  CHECK_THROWS_WITH(ProbesCsv::continued(path, {"force"}, 1),
                    Catch::Contains("other columns") && Catch::Contains("time, force"));
  const ProbesCsv fresh = ProbesCsv::continued(folder.path() / "new.csv", {"gap"}, 1);
  CHECK(fresh.series().rows.empty());
  CHECK(text_of(folder.path() / "new.csv") == "time,gap\n");
}

TEST_CASE("two probes of one name are refused") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(ProbesCsv(folder.path() / "p.csv", {"gap", "gap"}), InputError);
  CHECK_THROWS_AS(ProbesCsv(folder.path() / "p.csv", {"time"}), InputError);
}
