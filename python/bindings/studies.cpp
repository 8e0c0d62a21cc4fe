#include "python/bindings/studies.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <tbb/task_arena.h>

#include <filesystem>

#include "framework/batch/batch_preparation.hpp"
#include "framework/batch/resolved_case.hpp"
#include "framework/batch/varied_keys.hpp"
#include "framework/calibrate/calibrate_run.hpp"
#include "framework/compare/compare_run.hpp"
#include "framework/config/parse.hpp"
#include "framework/config/units.hpp"
#include "geometry/interrupt.hpp"
#include "geometry/plain_numbers.hpp"
#include "python/bindings/interrupts.hpp"

namespace tack::python {
namespace {

namespace py = pybind11;

// Prints a line to Python's sys.stdout, from any thread.
void print_line(const std::string& line) {
  const py::gil_scoped_acquire gil;
  py::print(line);
}

std::string compared(const std::string& path, const std::vector<std::string>& set, const std::string& output, int threads, bool quiet) {
  std::string folder;
  {
    const Interrupts interrupts;
    const py::gil_scoped_release released;
    const PlainNumbers plain;
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute([&] {
      folder = run_comparison({path, set, output, provenance_of("", arena.max_concurrency())}, [&](const std::string& line) {
                 if (interrupt_requested) throw Interrupted{};
                 if (!quiet) print_line(line);
               }).string();
    });
  }
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  return folder;
}

// program: an executable that runs a case. The thread that calls this starts the processes.
std::string calibrated(const std::string& path, const std::vector<std::string>& set, const std::string& output, const std::string& program, int jobs, int threads,
                       bool failed, bool quiet) {
  std::string folder;
  {
    const Interrupts interrupts;
    const py::gil_scoped_release released;
    const PlainNumbers plain;
    const CalibrateConfig config = load_calibration(path, set);
    FittedScenes scenes(config, program_digest());
    const auto print = [&](const std::string& line) {
      if (!quiet) print_line(line);
    };
    for (const std::string& line : scenes.warnings()) print("warning: " + line);
    CalibrationSettings settings;
    settings.file = std::filesystem::absolute(path).lexically_normal().string();
    settings.output = output;
    settings.program = program;
    settings.provenance = provenance_of("", threads > 0 ? threads : config.threads);
    settings.cases = calibration_description(config, scenes, settings.file, settings.provenance, jobs, threads);
    settings.rerun_failed = failed;
    const CalibrationObserver observer{print, [&](const std::string& phase, int, const PointEvaluation*) { print(phase); }, {}, {}};
    folder = run_calibration(config, scenes, settings, observer).folder.root.string();
  }
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  return folder;
}

// program: an executable that runs a case. The thread that calls this starts the processes.
std::string batched(const std::string& path, const std::vector<std::string>& set, const std::string& output, const std::string& program, int jobs, int threads,
                    const std::vector<std::string>& only, bool failed, bool quiet) {
  std::string folder;
  {
    const Interrupts interrupts;
    const py::gil_scoped_release released;
    const PlainNumbers plain;
    const auto print = [&](const std::string& line) {
      if (!quiet) print_line(line);
    };
    const BatchConfig config = load_batch(path, set);
    BatchSettings settings;
    settings.file = std::filesystem::absolute(path).lexically_normal().string();
    settings.output = output;
    settings.jobs = jobs;
    settings.threads = threads;
    settings.provenance = provenance_of("", threads > 0 ? threads : config.threads);
    settings.only = only;
    settings.rerun_failed = failed;
    PreparationObserver observer{print, [](const char*, size_t, size_t) {
                                   if (interrupt_requested) throw Interrupted{};
                                 }};
    const PreparedBatch batch = prepare_batch(config, settings, observer);
    BatchObserver running;
    running.ended = [&](const BatchCase& one, const CaseState& state) { print(one.name + ": " + std::string(to_string(state.status)) + (state.error.empty() ? "" : ": " + state.error)); };
    run_cases(program, batch.folder, batch.description.limits, batch.open, running);
    write_batch_table(batch.folder, batch.description);
    folder = batch.folder.root.string();
  }
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  return folder;
}

double in_si(double number, const std::string& unit) { return unit.empty() ? number : to_si(fmt::format("{} {}", number, unit), units::any); }

// Returns a dictionary for each key that a batch varies by values or within a range.
py::list varied(const std::string& path, const std::vector<std::string>& set) {
  const PlainNumbers plain;
  load_batch(path, set);  // refuses what is no batch
  Value root = parse_file(path);
  for (const std::string& assignment : set) apply_override(root, assignment);
  py::list all;
  const Value* vary = root.find("vary");
  for (const Value& entry : vary ? vary->items : std::vector<Value>()) {
    const Value *type = entry.find("type"), *keys = entry.find("keys");
    const bool samples = type->text == "latin_hypercube" || type->text == "sobol";
    if (!keys || !(samples || type->text == "grid" || type->text == "zip")) continue;
    for (const VariedKey& key : samples ? keys_with_ranges(*keys) : keys_with_values(*keys)) {
      py::list values;
      for (const Value& value : key.values) values.append(shown_text(value));
      py::dict d;
      d["name"] = key.column;
      d["key"] = key.key;
      d["values"] = values;
      d["low"] = key.range ? py::object(py::float_(in_si(key.range->from, key.range->unit))) : py::none();
      d["high"] = key.range ? py::object(py::float_(in_si(key.range->to, key.range->unit))) : py::none();
      d["log"] = key.range && key.range->log;
      d["whole"] = key.range && key.range->whole && key.range->unit.empty();  // values with a unit are not whole in SI
      all.append(d);
    }
  }
  return all;
}

}  // namespace

void bind_studies(py::module_& module) {
  module.def("compare", &compared, py::arg("path"), py::arg("set"), py::arg("output"), py::arg("threads"), py::arg("quiet"));
  module.def("batch", &batched, py::arg("path"), py::arg("set"), py::arg("output"), py::arg("program"), py::arg("jobs"), py::arg("threads"), py::arg("only"),
             py::arg("failed"), py::arg("quiet"));
  module.def("varied", &varied, py::arg("path"), py::arg("set"));
  module.def("calibrate", &calibrated, py::arg("path"), py::arg("set"), py::arg("output"), py::arg("program"), py::arg("jobs"), py::arg("threads"), py::arg("failed"),
             py::arg("quiet"));
}

}  // namespace tack::python
