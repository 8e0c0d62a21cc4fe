#include "python/bindings/recorded.hpp"

#include <pybind11/stl.h>
#include <tbb/task_arena.h>

#include <filesystem>
#include <ostream>
#include <streambuf>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/output/frame_fields.hpp"
#include "framework/output/output_format.hpp"
#include "framework/output/provenance.hpp"
#include "framework/report/report.hpp"
#include "framework/report/scene_data.hpp"
#include "framework/run/recorded_run.hpp"
#include "geometry/errors.hpp"
#include "geometry/plain_numbers.hpp"
#include "python/bindings/interrupts.hpp"

namespace tack::python {
namespace {

namespace py = pybind11;

// Writes lines to Python's sys.stdout, from any thread.
class Out : public std::streambuf {
 protected:
  int_type overflow(int_type c) override {
    if (c == traits_type::eof()) return traits_type::not_eof(c);
    line_ += static_cast<char>(c);
    if (c == '\n') sync();
    return c;
  }
  int sync() override {
    if (line_.empty()) return 0;
    const py::gil_scoped_acquire gil;
    py::print(std::exchange(line_, {}), py::arg("end") = "");
    return 0;
  }

 private:
  std::string line_;
};

std::string recorded(const std::string& path, const std::string& text, const std::vector<std::string>& set, const std::string& output, int threads, int steps, bool resume,
                     bool quiet) {
  std::string folder, error;
  RunStatus status = RunStatus::done;
  {
    const Interrupts interrupts;
    const py::gil_scoped_release released;
    const PlainNumbers plain;
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    Out buffer;
    std::ostream out(&buffer);
    arena.execute([&] {
      RunSettings settings;
      settings.output = output;
      settings.steps = steps;
      settings.resume = resume;
      ProgressOptions progress;
      if (quiet) progress.verbosity = Verbosity::quiet;
      RecordedRun run(text.empty() ? load_experiment(path, set) : parse_experiment(text, path, set), settings, provenance_of("", arena.max_concurrency()), out, progress);
      const RunSummary& summary = run.execute();
      folder = RunFolder::chosen_root(output, summary.name).string();
      status = summary.status;
      error = summary.error;
    });
  }
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (status == RunStatus::simulation_failed) throw SimulationError(error + " (results as far as they go: " + folder + ")");
  return folder;
}

std::string reported(const std::vector<std::string>& folders, const std::string& output, int frames, const std::string& status) {
  const py::gil_scoped_release released;
  ReportSettings settings;
  settings.folders.assign(folders.begin(), folders.end());
  settings.output = output;
  settings.frames = frames;
  settings.status = status;
  settings.version = this_build().version;
  settings.commit = this_build().revision();
  return write_report(settings).path.string();
}

std::vector<std::string> exported(const std::string& folder, const std::string& format, const std::string& output, const std::vector<std::string>& settings) {
  const py::gil_scoped_release released;
  Value value = Value::map();
  value.mark.file = std::make_shared<const std::string>("export to " + format);
  value.set("type", Value::scalar(format));
  for (const std::string& setting : settings) apply_override(value, setting);
  std::vector<std::string> paths;
  for (const auto& path : bind_component<OutputFormat>(value)->write(folder, output).paths) paths.push_back(path.string());
  return paths;
}

// Returns the SI units of a run's probes, by column, and units and descriptions of all fields that
// frames may have.
py::dict units_in(const std::string& folder) {
  const PlainNumbers plain;
  py::dict probes, fields, answer;
  for (const auto& [column, unit] : probe_units(std::filesystem::path(folder) / "scene.yaml")) probes[py::str(column)] = unit;
  for (const FrameFieldInfo& field : frame_fields()) fields[py::str(field.name)] = py::make_tuple(field.unit, field.doc);
  answer["probes"] = probes;
  answer["fields"] = fields;
  return answer;
}

std::string kind(const std::string& folder) {
  switch (kind_of(folder)) {
    case FolderKind::run: return "run";
    case FolderKind::comparison: return "comparison";
    case FolderKind::suite: return "suite";
    case FolderKind::batch: return "batch";
    case FolderKind::calibration: return "calibration";
  }
  return "";
}

}  // namespace

void bind_recorded(py::module_& module) {
  module.def("record", &recorded, py::arg("path"), py::arg("text"), py::arg("set"), py::arg("output"), py::arg("threads"), py::arg("steps"), py::arg("resume"), py::arg("quiet"));
  module.def("kind_of", &kind, py::arg("folder"));
  module.def("units", &units_in, py::arg("folder"));
  module.def("export", &exported, py::arg("folder"), py::arg("to"), py::arg("output"), py::arg("settings"));
  module.def("report", &reported, py::arg("folders"), py::arg("output"), py::arg("frames"), py::arg("status"));
}

}  // namespace tack::python
