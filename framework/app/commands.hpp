// The subcommands of the program, one file each; main.cpp reads their options from the command line.
// Each returns the exit code, or throws InputError or SimulationError.
#pragma once

#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "framework/run/recorded_run.hpp"

namespace tack {

inline constexpr int exit_done = 0, exit_expectation_failed = 1, exit_bad_input = 2,
                     exit_simulation_failed = 3, exit_interrupted = 130;

// Thrown by a command that this program lacks and tack_studies, beside it, has (in_studies.cpp): main goes on there.
struct InStudies : std::exception {};

// The experiment file and its overrides, as every command takes that reads a scene.
struct SceneOptions {
  std::string file;
  std::vector<std::string> overrides;  // "a.b=c"
};

// With `profile`, no frames are written unless overrides ask for them.
struct RunOptions : RunSettings {
  SceneOptions scene;
  std::string command_line;  // as a shell would take it
  int threads = 0;           // 0: all cores
  double memory = 0;         // GB that it may have; 0: any
  bool quiet = false, verbose = false;
};
// Simulates an experiment. Throws InputError before anything is written.
int run_command(const RunOptions& options);
ProgressOptions progress_options(const RunOptions& options);
int exit_code(RunStatus status);

struct CompareOptions {
  SceneOptions file;
  std::string output;        // empty: results/<name>
  std::string command_line;  // as a shell would take it
  int threads = 0;           // 0: all cores
  bool quiet = false;
};
// Speed against error of several solvers on the same problems.
int compare_command(const CompareOptions& options);

struct BatchOptions {
  SceneOptions file;
  std::string command_line;   // as a shell would take it
  std::string output;         // empty: results/<name>
  int jobs = 0, threads = 0;  // 0: as the file says
  bool dry_run = false;       // show the plan and what it will take
  bool failed = false;        // run those again that failed
  std::vector<std::string> only;  // names of cases, with * and ?; none: all
  bool slurm = false, no_wait = false;
  std::string collect;        // the folder of a batch, to make its table again
  std::optional<int> task;    // only that case of the batch in `output`, as a task of a job array
  bool quiet = false;
};
// Many experiments and one table of them. Calling it again goes on where it was ended.
int batch_command(const BatchOptions& options);

struct CalibrateOptions {
  SceneOptions file;
  std::string command_line;   // as a shell would take it
  std::string output;         // empty: results/<name>
  int jobs = 0, threads = 0;  // 0: as the file says
  bool dry_run = false;       // check everything, and say how long it will take
  bool failed = false;        // run those again that failed
  std::vector<std::string> only;  // names of cases, with * and ?; none: all
  bool slurm = false;
  bool quiet = false;
};
// Numbers of experiments, fitted to measured curves. Calling it again goes on where it was ended.
int calibrate_command(const CalibrateOptions& options);

struct ReportOptions {
  std::vector<std::string> folders;
  std::string output;              // the file; empty: report.html in the folder
  int frames = 0;                  // 0: as many as a page should carry
  std::vector<std::string> cases;  // of a batch
};
// One HTML file for a run, several runs, a comparison or a batch.
int report_command(const ReportOptions& options);

struct RenderOptions {
  std::vector<std::string> folders;    // of runs
  std::string view;                    // the file of a view; empty: the usual one
  std::vector<std::string> overrides;  // "a.b=c": of the view
  std::string output = "picture.png";
  bool quiet = false;
};
// A picture or a film of runs, side by side.
int render_command(const RenderOptions& options);

// A scene; with `run` it is run, and the folder is that of the results; or a folder of results instead of a scene.
struct ViewOptions : RunOptions {
  bool run = false;
  bool no_browser = false;
};
// Pages about them, served to this machine until Ctrl-C; of a scene that is not run or of results, with an output, one file instead.
int view_command(const ViewOptions& options);

struct PlotOptions {
  std::vector<std::string> folders;  // runs, or one batch, or one comparison
  std::string output;                // folder of the pictures; empty: plots in the folder; of several, in the working directory
  std::string x, y;                  // a single picture of these probes, or of these columns of a batch's table
  std::vector<std::string> by;
  bool log_x = false, log_y = false;
  std::vector<double> x_range;  // the part of x that is shown; empty: all
  std::string style;                    // a file of how they look; empty: as usual
  std::vector<std::string> overrides;   // "a.b=c": of the style
  std::vector<std::string> data;  // files of measured or reference points with columns of the same names, drawn as marks
};
// Pictures for papers, as SVG and PNG, and PDF if the style says so.
int plot_command(const PlotOptions& options);

struct CheckOptions : SceneOptions {
  std::string gradient;          // "PROBE:KEY": runs it, and compares that derivative with differences; empty: no run
  double gradient_step = 1e-4;   // of those differences, relative to the number
  int threads = 0;               // 0: all cores
};
// Validates an experiment without running it: keys, meshes, pairs, the start, and the derivatives of the
// whole incremental potential at the start.
int check_command(const CheckOptions& options);

struct ListOptions {
  std::string kind, name;                         // empty: all
  std::string reference, schema, compare_schema, batch_schema, calibrate_schema, plot_schema;  // files to write instead
  std::vector<std::string> plugins;                             // whose components are listed too

  bool writes_files() const {
    return !(reference.empty() && schema.empty() && compare_schema.empty() && batch_schema.empty() && calibrate_schema.empty() && plot_schema.empty());
  }
};
// What can be named in a scene file; describe_command if files are to be written.
int list_command(const ListOptions& options);
// Writes the reference page and the JSON schemas.
int describe_command(const ListOptions& options);

struct LawOptions {
  std::vector<std::string> words;  // a scene or the file of an adhesion, and keys of it ("a.b=c")
  std::string type;                // of an adhesion, instead of a file
  std::string output;              // folder of pictures and tables; empty: none
  std::string young, contact_distance, barrier_stiffness, speed, pressure;  // with units; empty: not given
  std::vector<std::string> plugins;
};
// Adhesion laws by themselves: their figures, curves and checks.
int law_command(const LawOptions& options);

struct MeshOptions {
  std::string operation;            // `info`, `convert`, `sdf`, or a component of kind mesh_operation
  std::vector<std::string> words;   // files and parameters of the operation ("edge_length=5 mm"), in any order
  std::string output;               // the file to write; empty for `info`
  std::string object;               // `sdf`: of an experiment; empty if the file is that of a level set
};
// What a mesh file holds and how good it is, or an operation on it.
int mesh_command(const MeshOptions& options);
// The same mesh in another format, by its words: the file, units and what is written of it.
int mesh_convert(const std::string& path, const std::vector<std::string>& settings, const MeshOptions& options);
// The surface of a level set, by its words: the file and overrides of its keys.
int mesh_sdf(const std::string& path, const std::vector<std::string>& settings, const MeshOptions& options);

}  // namespace tack
