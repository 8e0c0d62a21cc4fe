// The table of tack batch: its columns, and that the folder alone gives it again.
#include <algorithm>
#include <catch2/catch.hpp>

#include "framework/output/csv.hpp"
#include "tests/support/batch_files.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// Returns a number of the table's first row.
double number_of(const fs::path& folder, const std::string& column) {
  const CsvTexts table = read_csv_texts(folder / "results.csv");
  const auto at = std::find(table.columns.begin(), table.columns.end(), column);
  REQUIRE(at != table.columns.end());
  return csv_number(table.rows.at(0).at(static_cast<size_t>(at - table.columns.begin()))).value();
}

}  // namespace

TEST_CASE("names that spreadsheets take for formulas are none in the table", "[batch]") {
  const BatchFiles files("name: formulas\nbase: tiny.yaml\nset: [output.frames=false, probes.0.name='=1+1', 'expect=[]']\n"
                    "vary: [{type: cases, cases: [{name: \"=cmd|'/C calc'!A0\"}, {name: '+b'}]}]\n");
  const ProgramResult result = run_tack(files.path, {"batch", "batch.yaml", "-o", "b"});
  INFO(result.out << result.err);
  REQUIRE(result.exit_code == 0);
  const std::string table = file_text(files.path / "b" / "results.csv");
  CHECK(contains(table, ",'=1+1.final,"));
  CHECK(contains(table, ",'=cmd|'/C calc'!A0,done"));
  CHECK(contains(table, ",'+b,done"));
  const ProgramResult picture = run_tack(files.path, {"plot", "b", "--x", "steps", "--y", "=1+1.final"});
  INFO(picture.out << picture.err);
  CHECK(picture.exit_code != 2);  // it knows the column
}

TEST_CASE("the table is made again from the folder alone", "[batch]") {
  const BatchFiles files(steps_batch + "statistics: [{name: lowest, probe: height, statistic: min}, {probe: stickiness_y, statistic: final}]\n");
  REQUIRE(run_tack(files.path, {"batch", "batch.yaml", "-o", "b", "--set", "vary.0.keys={time.step: [0.01 s]}"}).exit_code == 0);
  const std::string table = file_text(files.path / "b" / "results.csv");
  CHECK(contains(table, ",lowest,stickiness_y: final,"));
  fs::remove(files.path / "b" / "results.csv");
  fs::remove(files.path / "batch.yaml");
  CHECK(run_tack(files.path, {"batch", "--collect", "b"}).exit_code == 0);
  CHECK(file_text(files.path / "b" / "results.csv") == table);
  // tests/python/test_labelled.py reads the contents of such a file.
  CHECK_FALSE(fs::exists(files.path / "b" / "results.h5"));
  CHECK(run_tack(files.path, {"batch", "--collect", "b", "--table", "hdf5"}).exit_code == 0);
  CHECK(file_text(files.path / "b" / "results.h5").starts_with("\x89HDF\r\n"));
  CHECK(file_text(files.path / "b" / "results.csv") == table);
  CHECK(run_tack(files.path, {"batch", "--collect", "b"}).exit_code == 0);
  CHECK(fs::exists(files.path / "b" / "results.h5"));  // the folder keeps the choice
  CHECK(run_tack(files.path, {"batch", "--collect", "b", "--table", "csv"}).exit_code == 0);
  CHECK_FALSE(fs::exists(files.path / "b" / "results.h5"));
  const ProgramResult nothing = run_tack(files.path, {"batch", "--collect", "."});
  CHECK(nothing.exit_code == 2);
  CHECK(contains(nothing.err, "holds no batch"));
}

TEST_CASE("a column may be how far cases are from a measured curve", "[batch]") {
  const BatchFiles files(steps_batch + "statistics: [{name: off, probe: height, statistic: deviation, along: time, follows: {file: height.csv, to: 0.15 s, relative_to: peak}}]\n");
  write_file(files.path / "height.csv", "time [s], height [mm]\n0.05, 50\n0.1, 200\n0.2, 300\n");
  const ProgramResult result = run_tack(files.path, {"batch", "batch.yaml", "-o", "b", "--set", "vary.0.keys={time.step: [0.01 s]}"});
  INFO(result.out << result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(number_of(files.path / "b", "off") == Approx((0.05 + 0.1) / 0.4).epsilon(0.02));  // its centre lies at 0.1 m
  const std::string text = file_text(files.path / "b" / "results.csv");
  fs::remove(files.path / "b" / "results.csv");
  CHECK(run_tack(files.path, {"batch", "--collect", "b"}).exit_code == 0);
  CHECK(file_text(files.path / "b" / "results.csv") == text);
}

TEST_CASE("a statistic of a stage is that of the samples in it", "[batch][protocol]") {
  const BatchFiles files(R"(name: press
base: press.yaml
statistics:
  - {probe: height, statistic: min, stage: load}
  - {name: risen, probe: height, statistic: max, stage: unload}
  - {name: all, probe: height, statistic: max}
)");
  write_file(files.path / "press.yaml", R"(name: press
time: {step: 10 ms, duration: 1 s, integrator: quasi_static}
objects:
  - name: block
    shape: {type: box, size: [10 mm, 10 mm, 10 mm], cells: [2, 2, 2]}
    energies: [{type: neo_hookean, young: 100 kPa, poisson: 0, density: 1000}]
    motion:
      - {type: fixed, select: {type: face, direction: [0, -1, 0]}}
      - {type: driven, drive: head, direction: [0, 1, 0], select: {type: face, direction: [0, 1, 0]}}
probes:
  - name: height
    type: separation
    from: {object: block, select: {type: face, direction: [0, -1, 0]}}
    to: {object: block, select: {type: face, direction: [0, 1, 0]}}
    direction: [0, 1, 0]
protocols:
  - name: press
    stages:
      - {name: load, drive: {head: {velocity: -1 mm/s}}, until: {time: 0.1 s}}
      - {name: unload, drive: {head: {velocity: 1 mm/s}}, until: {time: 0.05 s}}
output: {frames: false}
)");
  const ProgramResult result = run_tack(files.path, {"batch", "batch.yaml", "-o", "b"});
  INFO(result.out << result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(number_of(files.path / "b", "height: min in stage load") == Approx(9.9e-3));
  CHECK(number_of(files.path / "b", "risen") == Approx(9.95e-3));
  CHECK(number_of(files.path / "b", "all") == Approx(10e-3));
  const std::string table = file_text(files.path / "b" / "results.csv");
  fs::remove(files.path / "b" / "results.csv");
  CHECK(run_tack(files.path, {"batch", "--collect", "b"}).exit_code == 0);
  CHECK(file_text(files.path / "b" / "results.csv") == table);
  // The table says why a case that has run already has no number.
  CHECK(run_tack(files.path, {"batch", "batch.yaml", "-o", "b", "--set", "statistics.1.over=[5 s, 6 s]"}).exit_code == 0);
  CHECK(contains(file_text(files.path / "b" / "results.csv"), "statistic 'risen': there are no samples"));
  for (const char* folder : {"b", "c"}) {
    const ProgramResult unknown = run_tack(files.path, {"batch", "batch.yaml", "-o", folder, "--set", "statistics.1.stage=unlaod"});
    CHECK(unknown.exit_code == 2);
    CHECK(contains(unknown.err, "no protocol has a stage 'unlaod'; did you mean 'unload'?"));
  }
}
