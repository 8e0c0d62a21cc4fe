// The subcommands of the program, one file each; command_line.cpp reads their options. Each returns
// the exit code, or throws InputError or SimulationError.
#pragma once

#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "framework/experiment/load_experiment.hpp"
#include "framework/run/recorded_run.hpp"

namespace tack {

inline constexpr int exit_done = 0, exit_expectation_failed = 1, exit_bad_input = 2,
                     exit_simulation_failed = 3, exit_interrupted = 130;

// Thrown by a command that tack lacks and tack_studies has (in_studies.cpp); main then executes
// tack_studies.
struct InStudies : std::exception {};

// The experiment file and its overrides, for every command that reads a scene.
struct SceneOptions {
  std::string file;
  std::vector<std::string> overrides;  // "a.b=c"
  std::vector<std::string> plugins;    // libraries besides those that the file names
};
// Loads the plugins of the options and returns the overrides with one more, for `plugins`: what a
// run keeps then names them, so that it can be repeated and resumed. Throws InputError for a plugin
// that cannot be loaded.
std::vector<std::string> overrides_with_plugins(const SceneOptions& options);
// Returns the scene with its overrides and plugins. Throws InputError.
LoadedExperiment loaded_scene(const SceneOptions& options);

// With `profile`, no frames are written unless overrides ask for them.
struct RunOptions : RunSettings {
  SceneOptions scene;
  std::string command_line;  // as it would be typed in a shell
  int threads = 0;           // 0: all cores
  double memory = 0;         // memory limit in GB; 0: none
  bool quiet = false, verbose = false;
};
// Simulates an experiment. Throws InputError before anything is written.
int run_command(const RunOptions& options);
ProgressOptions progress_options(const RunOptions& options);
int exit_code(RunStatus status);

struct CompareOptions {
  SceneOptions file;
  std::string output;        // empty: results/<name>
  std::string command_line;  // as it would be typed in a shell
  int threads = 0;           // 0: all cores
  bool quiet = false;
};
// Compares speed against error of several solvers on the same problems.
int compare_command(const CompareOptions& options);

struct SolveOptions {
  SceneOptions step;                 // a stored step, and overrides of its scene
  std::vector<std::string> solvers;  // names or YAML maps; empty: the solver of the scene
  std::vector<std::string> plugins;
  std::string json;                 // file to write the results to; empty: none
  std::optional<double> cpu_limit;  // of each solve [s]
  double tolerance_scale = 1;
  int threads = 0;             // 0: all cores
  bool no_minimum = false;     // measures no distance from the minimum
  bool store_minimum = false;  // keeps a minimum that was found in the file
  bool check = false;          // follows each result to its own minimum
};
// Solves a stored step with each solver and prints a table.
int solve_command(const SolveOptions& options);

struct SuiteOptions {
  std::vector<std::string> paths;    // problems and folders of them; empty: the shipped suite
  std::vector<std::string> solvers;  // names or YAML maps; empty: all registered minimisers
  std::vector<std::string> plugins;
  std::vector<double> tolerance_scales;  // empty: 1
  double cpu_limit = 20;                 // of each solve [s]
  int threads = 1, jobs = 1;             // of each solve; concurrent solves
  std::string output;                    // empty: results/suite
  std::string command_line;              // as it would be typed in a shell
  bool quiet = false;
};
// Solves all problems of folders with all solvers and writes a leaderboard.
int suite_command(const SuiteOptions& options);

struct BatchOptions {
  SceneOptions file;
  std::string command_line;       // as it would be typed in a shell
  std::string output;             // empty: results/<name>
  int jobs = 0, threads = 0;      // 0: as the file says
  bool dry_run = false;           // show the plan and its estimated duration
  bool failed = false;            // run failed cases again
  std::vector<std::string> only;  // names of cases, with * and ?; empty: all
  std::string table;              // format of the table, csv or hdf5; empty: as the file says
  bool slurm = false, no_wait = false;
  // The folder of a batch whose table is to be made again.
  std::string collect;
  // The only case to run of the batch in `output`, as a task of a job array.
  std::optional<int> task;
  // How often Slurm may restart the task when its time limit is near (SIGUSR1).
  int requeues = 0;
  bool quiet = false;
};
// Runs many experiments and makes one table of their results. A second call continues an
// interrupted batch.
int batch_command(const BatchOptions& options);

struct CalibrateOptions {
  SceneOptions file;
  std::string command_line;       // as it would be typed in a shell
  std::string output;             // empty: results/<name>
  int jobs = 0, threads = 0;      // 0: as the file says
  bool dry_run = false;           // check everything and estimate the duration
  bool failed = false;            // run failed cases again
  std::vector<std::string> only;  // names of cases, with * and ?; empty: all
  bool slurm = false;
  bool quiet = false;
};
// Fits scene parameters of experiments to measured curves. A second call continues an interrupted
// calibration.
int calibrate_command(const CalibrateOptions& options);

struct ReportOptions {
  std::vector<std::string> folders;
  std::string output;              // the file; empty: report.html in the folder
  int frames = 0;                  // 0: a default number
  std::vector<std::string> cases;  // cases of a batch
};
// Writes one HTML file for a run, several runs, a comparison or a batch.
int report_command(const ReportOptions& options);

struct RenderOptions {
  std::vector<std::string> folders;    // folders of runs
  std::string view;                    // the file of a view; empty: the default view
  std::vector<std::string> overrides;  // overrides of the view, "a.b=c"
  std::string output = "picture.png";
  std::string with = "browser";  // or "blender"
  bool quiet = false;
};
// Writes a picture or a film of runs, side by side.
int render_command(const RenderOptions& options);

struct ExportOptions {
  std::string folder;                 // folder of a run
  std::string format;                 // type of an output format
  std::string output;                 // file or folder to write; empty: below the folder's `export`
  std::vector<std::string> settings;  // keys of the format, "a=b"
  std::vector<std::string> plugins;
};
// Writes the shapes of a run in another file format.
int export_command(const ExportOptions& options);

// Views a scene, or a folder of results. With `run`, runs the scene; its output folder is that of
// the results.
struct ViewOptions : RunOptions {
  bool run = false;
  bool no_browser = false;
};
// Serves pages about the scene or results to this machine until Ctrl-C. With an output, for results
// or a scene that is not run, writes one HTML file instead.
int view_command(const ViewOptions& options);

struct PlotOptions {
  std::vector<std::string> folders;  // runs, or one batch, or one comparison
  // Folder of the pictures. Empty: plots in the results folder; for several folders, in the working
  // directory.
  std::string output;
  // One picture of these probes, or of these columns of a batch's table.
  std::string x, y;
  std::vector<std::string> by;
  bool log_x = false, log_y = false;
  std::vector<double> x_range;         // displayed range of x; empty: all
  std::string style;                   // a style file; empty: the default style
  std::vector<std::string> overrides;  // overrides of the style, "a.b=c"
  // Files of measured or reference points, with the same column names; drawn as marks.
  std::vector<std::string> data;
};
// Draws pictures for papers as SVG and PNG, and as PDF if the style asks for it.
int plot_command(const PlotOptions& options);

struct CheckOptions : SceneOptions {
  // "PROBE:KEY": runs the scene and compares this derivative with finite differences. Empty: no
  // run.
  std::string gradient;
  double gradient_step = 1e-4;  // of the finite differences, relative to the parameter
  int threads = 0;              // 0: all cores
  std::string picture;          // file (.png) of the initial state; empty: none
};
// Validates an experiment without running it: keys, meshes, pairs, the initial state, and the
// derivatives of the incremental potential at the initial state.
int check_command(const CheckOptions& options);
// Calls check_command, then draws the picture.
int picture_command(const CheckOptions& options);

struct ListOptions {
  std::string kind;                // empty: all
  std::vector<std::string> names;  // a component of the kind, or further words of a search
  // Files to write instead of the list.
  std::string reference, schema, compare_schema, batch_schema, calibrate_schema, plot_schema;
  // Components of these are listed too.
  std::vector<std::string> plugins;

  bool writes_files() const {
    return !(reference.empty() && schema.empty() && compare_schema.empty() &&
             batch_schema.empty() && calibrate_schema.empty() && plot_schema.empty());
  }
};
// Kind of components that only tack_studies has: those of batches.
inline constexpr const char* study_kind = "variation";
// Lists the components that a scene file can name, or what a search for a word finds; calls
// describe_command if files are to be written. Throws InStudies for `study_kind` in a program
// without it.
int list_command(const ListOptions& options);
// Writes the reference page and the JSON schemas.
int describe_command(const ListOptions& options);

struct NewOptions {
  std::string name;    // of a template; empty: list them
  std::string output;  // file to write; empty: NAME.yaml in the working directory
};
// Writes a template of a scene, or lists the templates.
int new_command(const NewOptions& options);

struct LawOptions {
  // A scene or the file of an adhesion, and keys of it ("a.b=c").
  std::vector<std::string> words;
  std::string type;    // type of an adhesion, instead of a file
  std::string output;  // folder of pictures and tables; empty: no files
  // With units; empty: not given.
  std::string young, contact_distance, barrier_stiffness, speed, pressure, temperature;
  std::vector<std::string> plugins;
};
// Studies adhesion laws without a scene: metrics, curves and derivative checks.
int law_command(const LawOptions& options);

struct MeshOptions {
  // `info`, `convert`, `sdf`, or a component of kind mesh_operation.
  std::string operation;
  // Files and parameters of the operation ("edge_length=5 mm"), in any order.
  std::vector<std::string> words;
  std::string output;  // the file to write; empty for `info`
  // `sdf`: object of an experiment; empty if the file is a level set.
  std::string object;
};
// Prints contents and quality of a mesh file, or applies an operation to it.
int mesh_command(const MeshOptions& options);
// Writes a mesh in another format. `settings`: the output file, units, and the parts of the mesh to
// write.
int mesh_convert(const std::string& path, const std::vector<std::string>& settings,
                 const MeshOptions& options);
// Writes the surface of a level set as a mesh. `settings`: the output file and overrides of its
// keys.
int mesh_sdf(const std::string& path, const std::vector<std::string>& settings,
             const MeshOptions& options);

}  // namespace tack
