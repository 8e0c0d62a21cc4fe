// Commands, options and help texts.
#include "framework/app/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "framework/app/commands.hpp"
#include "framework/app/described_commands.hpp"
#include "framework/app/help_formatter.hpp"
#include "framework/app/misspelt_word.hpp"
#include "framework/app/number_options.hpp"
#include "framework/app/scene_file_options.hpp"
#include "framework/app/version_text.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"
#include "geometry/own_library.hpp"

namespace tack {
namespace {

// Each command adds itself and, if it is called, sets the exit code.
class CommandLine {
 public:
  CommandLine() {
    app_.name("tack");
    app_.formatter(std::make_shared<HelpFormatter>());
    app_.failure_message([](const CLI::App* app, const CLI::Error& error) { return "error: " + CLI::FailureMessage::simple(app, error); });
    app_.set_version_flag("--version", version_text());
    app_.require_subcommand(1);
    if (!is_installed()) app_.footer("`./tack test` runs the tests.");
    add_new();
    add_run();
    add_view();
    add_profile();
    add_solve();
    add_suite();
    add_compare();
    add_batch();
    add_calibrate();
    add_plot();
    add_report();
    add_render();
    add_export();
    add_check();
    add_list();
    add_law();
    add_mesh();
    add_completion();
  }

  int execute(int argc, char** argv) {
    run_.command_line = view_.command_line = profile_.command_line = suite_.command_line = compare_.command_line = batch_.command_line = calibrate_.command_line =
        shell_line({argv, argv + argc});
    if (argc < 2) {
      fmt::print(stderr, "{}", app_.help());
      return exit_bad_input;
    }
    std::vector<std::string> words = as_options({argv + 1, argv + argc});
    std::reverse(words.begin(), words.end());  // in the order of CLI11
    try {
      app_.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
      if (const std::string what = misspelt_word(app_, {argv + 1, argv + argc}); error.get_exit_code() != 0 && !what.empty()) throw InputError(what);
      return app_.exit(error) == 0 ? exit_done : exit_bad_input;
    }
    return exit_code_;
  }

 private:
  // Aliases that other programs have: `tack help run` and `tack version`.
  static std::vector<std::string> as_options(std::vector<std::string> words) {
    if (words[0] == "version" && words.size() == 1) words[0] = "--version";
    if (words[0] != "help") return words;
    words.erase(words.begin());
    words.emplace_back("--help");
    return words;
  }

  void add_new() {
    CLI::App* scene = app_.add_subcommand("new", "Write a commented scene to begin with: probe tack, peel, lap shear, drape, stack");
    scene->add_option("template", new_.name, "template; without one, all are listed");
    scene->add_option("-o,--output", new_.output, "file to write (default: probe_tack.yaml for probe-tack)")->type_name("YAML");
    scene->callback([this] { exit_code_ = new_command(new_); });
  }

  void add_run() {
    CLI::App* run = app_.add_subcommand("run", "Run a scene");
    add_run_options(*run, run_);
    run->add_flag("--resume", run_.resume, "continue from the newest checkpoint of the results folder");
    run->add_option("--memory", run_.memory, "memory limit in GB (default: none); a run that needs more fails")->check(number_above_zero);
    run->add_option("--dump-problem", run_.dump_problems,
                    "store the minimisation problem of a step: step=K, or hardest=N for the N steps with most iterations (repeatable)")
        ->take_all()->allow_extra_args(false);
    run->callback([this] {
      settle(run_.scene);
      exit_code_ = run_command(run_);
    });
  }

  void add_view() {
    CLI::App* view = app_.add_subcommand("view", "Show a scene, a live run or results in a browser on this machine");
    add_run_options(*view, view_);
    view->get_option(file_word)->description("scene file (YAML) or results folder");
    view->get_option("--output")
        ->description("file (.html) to write instead of serving a page; with --run: results folder (default: results/NAME)")->type_name("FILE");
    CLI::Option* run = view->add_flag("--run", view_.run, "run the scene and show frames and curves live, with buttons to pause and stop");
    for (const char* name : {"--threads", "--steps", "--quiet", "--verbose"}) view->get_option(name)->needs(run);
    view->add_flag("--resume", view_.resume, "with --run: continue from the newest checkpoint of the results folder")->needs(run);
    view->add_flag("--no-browser", view_.no_browser, "print the address without opening a browser");
    view->callback([this] {
      settle(view_.scene);
      exit_code_ = view_command(view_);
    });
  }

  void add_profile() {
    CLI::App* profile = app_.add_subcommand("profile", "Run a scene and report the cost of each phase, and which keys change it");
    add_run_options(*profile, profile_);
    profile->add_option("--cores", profile_.cores, "predict the speed-up on this many cores (N or N,N,...) from a run with one thread, and list what limits it")
        ->delimiter(',')->allow_extra_args(false)->check(core_count);
    profile->callback([this] {
      settle(profile_.scene);
      profile_.profile = true;
      exit_code_ = run_command(profile_);
    });
  }

  void add_solve() {
    CLI::App* solve = app_.add_subcommand("solve", "Solve a stored step with one or several solvers: iterations, seconds, distance from its minimum");
    add_scene_options(*solve, solve_.step);
    solve->get_option(file_word)->description("stored step (tack run --dump-problem)")->type_name("PROBLEM");
    solve->get_option("--set")->description("override keys of its scene: a.b=c (one or more; repeatable)");
    solve->add_option("--solver", solve_.solvers, "minimizer by name, or a YAML map that is laid over the scene's `solver` (repeatable; default: the scene's)")
        ->type_name("SOLVER")->take_all()->allow_extra_args(false);
    add_plugins(*solve, solve_.plugins, "solvers");
    solve->add_option("--cpu-limit", solve_.cpu_limit, "processor seconds of each solve, instead of the scene's iteration limit (default: none)")->check(number_above_zero);
    solve->add_option("--tolerance-scale", solve_.tolerance_scale, "factor of the scene's tolerances (default: 1)")->check(number_above_zero);
    solve->add_flag("--check", solve_.check, "follow each result to its own minimum by projected Newton: which one, error, and stopping norm of the result");
    solve->add_option("--json", solve_.json, "write the results to a file")->type_name("FILE");
    solve->add_option("--threads", solve_.threads, "threads (default: all cores)")->check(whole_number_above_zero);
    CLI::Option* none = solve->add_flag("--no-minimum", solve_.no_minimum, "do not search for the minimum if the file has none, and measure no distance from it");
    solve->add_flag("--store-minimum", solve_.store_minimum, "write the minimum that was found into the file")->excludes(none);
    solve->callback([this] {
      settle(solve_.step);
      exit_code_ = solve_command(solve_);
    });
  }

  void add_suite() {
    CLI::App* suite = app_.add_subcommand("suite", "Solve a folder of stored steps with all solvers side by side: a leaderboard");
    suite->add_option("problem", suite_.paths, "stored steps (*.problem), or folders of them (default: experiments/suite)")->type_name("PROBLEM");
    suite->add_option("--solver", suite_.solvers, "minimizer by name, or a YAML map that is laid over the scene's `solver` (repeatable; default: all minimizers)")
        ->type_name("SOLVER")->take_all()->allow_extra_args(false);
    add_plugins(*suite, suite_.plugins, "solvers");
    suite->add_option("--cpu-limit", suite_.cpu_limit, "processor seconds of each solve (default: 20)")->check(number_above_zero);
    suite->add_option("--tolerance-scale", suite_.tolerance_scales, "factor of the scenes' tolerances; several give curves of work against precision (repeatable; default: 1)")
        ->take_all()->allow_extra_args(false)->check(number_above_zero);
    suite->add_option("--threads", suite_.threads, "threads of each solve (default: 1)")->check(whole_number_above_zero);
    suite->add_option("--jobs", suite_.jobs, "concurrent solves (default: 1); more disturb each other's times")->check(whole_number_above_zero);
    suite->add_option("-o,--output", suite_.output, "results folder (default: results/suite)")->type_name("FOLDER");
    suite->add_flag("-q,--quiet", suite_.quiet, "print the final table only");
    suite->callback([this] { exit_code_ = suite_command(suite_); });
  }

  void add_compare() {
    CLI::App* compare = app_.add_subcommand("compare", "Compare speed and error of several solvers");
    add_scene_options(*compare, compare_.file, "comparison");
    add_plugins(*compare, compare_.file.plugins, "components");
    add_output(*compare, compare_.output, compare_.threads);
    compare->add_flag("-q,--quiet", compare_.quiet, "print errors only");
    compare->callback([this] {
      settle(compare_.file);
      exit_code_ = compare_command(compare_);
    });
  }

  void add_batch() {
    CLI::App* batch = app_.add_subcommand("batch", "Run a parameter study: many cases concurrently, with one table of results");
    add_scene_options(*batch, batch_.file, "batch");
    add_output(*batch, batch_.output, batch_.threads);
    batch->add_option("--jobs", batch_.jobs, "concurrent cases (default: as many as cores allow)")->check(whole_number_above_zero);
    batch->add_flag("--dry-run", batch_.dry_run, "check and list all cases and estimate the run time");
    batch->add_flag("--failed", batch_.failed, "repeat the cases that failed");
    batch->add_option("--only", batch_.only, "run only these cases, by name as shown by --dry-run; * matches any text")->type_name("CASE");
    batch->add_option("--table", batch_.table, "hdf5: write the table as results.h5, too; csv: as results.csv alone (default: as the file says, and the folder with --collect)")->check(CLI::IsMember({"csv", "hdf5"}));
    CLI::Option* slurm = batch->add_flag("--slurm", batch_.slurm, "run the cases as a job array of Slurm");
    batch->add_flag("--no-wait", batch_.no_wait, "with --slurm: submit and exit without waiting")->needs(slurm);
    batch->add_option("--collect", batch_.collect, "rebuild the table of a batch folder without running anything")->type_name("FOLDER");
    CLI::Option* task =
        batch->add_option("--task", batch_.task, "run only this case (index from 0) of the batch in folder -o, as a job array does");
    batch->add_option("--requeues", batch_.requeues, "with --task: at SIGUSR1, end the case and queue the task of Slurm again, at most this often")
        ->needs(task)->check(whole_number_above_zero);
    batch->add_flag("-q,--quiet", batch_.quiet, "print errors only");
    batch->callback([this] {
      if (batch_.task && batch_.output.empty()) throw CLI::RequiredError("--task: -o");
      if (!batch_.task && batch_.collect.empty()) settle(batch_.file);
      exit_code_ = batch_command(batch_);
    });
  }

  void add_calibrate() {
    CLI::App* calibrate = app_.add_subcommand("calibrate", "Fit scene parameters to measured curves");
    add_scene_options(*calibrate, calibrate_.file, "calibration");
    add_output(*calibrate, calibrate_.output, calibrate_.threads);
    calibrate->add_option("--jobs", calibrate_.jobs, "concurrent runs (default: as many as cores allow)")->check(whole_number_above_zero);
    calibrate->add_flag("--dry-run", calibrate_.dry_run, "check everything and estimate the run time");
    calibrate->add_flag("--failed", calibrate_.failed, "repeat the runs that failed");
    calibrate->add_flag("--slurm", calibrate_.slurm, "run concurrent evaluations as job arrays of Slurm");
    calibrate->add_flag("-q,--quiet", calibrate_.quiet, "print errors only");
    calibrate->callback([this] {
      settle(calibrate_.file);
      exit_code_ = calibrate_command(calibrate_);
    });
  }

  void add_plot() {
    CLI::App* plot = app_.add_subcommand("plot", "Plot runs, a batch or a comparison (SVG, PNG)");
    plot->add_option("folder", plot_.folders, "results folders of runs, or one folder of a batch or comparison")->required()->type_name("FOLDER");
    plot->add_option("-o,--output", plot_.output, "folder of the pictures (default: plots in the results folder; for several folders, here)")->type_name("FOLDER");
    CLI::Option* x = plot->add_option("--x", plot_.x, "x axis: a probe or time for runs, a column of results.csv for a batch");
    CLI::Option* y = plot->add_option("--y", plot_.y, "y axis: a probe for runs, a column of results.csv for a batch")->needs(x);
    x->needs(y);
    plot->add_option("--by", plot_.by, "for a batch: one curve per value of this column (repeatable; default: all other columns that vary)")
        ->take_all()->allow_extra_args(false)->needs(x);
    plot->add_flag("--log-x", plot_.log_x, "logarithmic axis")->needs(x);
    plot->add_option("--x-range", plot_.x_range, "smallest and largest x shown, in SI")->expected(2)->needs(x);
    plot->add_option("--data", plot_.data, "file (CSV, with units) with columns of the same names, drawn as marks (repeatable)")
        ->type_name("CSV")->take_all()->allow_extra_args(false)->needs(x);
    plot->add_flag("--log-y", plot_.log_y, "logarithmic axis")->needs(x);
    plot->add_option("--style", plot_.style, "file (YAML) with paper size, fonts, labels, colours, or PDF as an additional format")->type_name("YAML");
    plot->add_option("--set", plot_.overrides, "override keys of the style: a.b=c (one or more; repeatable)")->take_all()->allow_extra_args(true);
    plot->callback([this] { exit_code_ = plot_command(plot_); });
  }

  void add_report() {
    CLI::App* report = app_.add_subcommand("report", "Write one HTML report of runs, a comparison, a suite or a batch: charts, tables, 3D view");
    report->add_option("folder", report_.folders, "results folders of runs, or one folder of a comparison, suite or batch")->required()->type_name("FOLDER");
    report->add_option("-o,--output", report_.output, "file to write (default: report.html in the results folder; for several folders, here)")->type_name("FILE");
    report->add_option("--frames", report_.frames, "number of frames to keep (default: 200, fewer for large meshes)")->check(whole_number_above_zero);
    report->add_option("--case", report_.cases, "for a batch: also show the run of this case (repeatable)")
        ->take_all()->allow_extra_args(false);
    report->callback([this] { exit_code_ = report_command(report_); });
  }

  void add_render() {
    CLI::App* render = app_.add_subcommand("render", "Render runs side by side to a picture (PNG) or a film (MP4, GIF)");
    render->add_option("folder", render_.folders, "results folders of runs")->required()->type_name("FOLDER");
    render->add_option("-o,--output", render_.output, "output file; its extension selects the format")->type_name("PICTURE")->capture_default_str();
    render->add_option("--view", render_.view, "file (YAML) with size, camera, materials of objects, colours by a field")->type_name("YAML");
    render->add_option("--set", render_.overrides, "override keys of the view: a.b=c (one or more; repeatable)")->take_all()->allow_extra_args(true);
    render->add_option("--with", render_.with, "what draws: a browser, in seconds, or Blender's path tracer Cycles, in minutes")
        ->check(CLI::IsMember({"browser", "blender"}))->capture_default_str();
    render->add_flag("-q,--quiet", render_.quiet, "print errors only");
    render->callback([this] { exit_code_ = render_command(render_); });
  }

  void add_export() {
    CLI::App* exported = app_.add_subcommand("export", "Write the shapes of a run for Blender, Houdini or a browser");
    exported->add_option("folder", export_.folder, "results folder of a run, finished or under way")->required()->type_name("FOLDER");
    exported->add_option("--to", export_.format, "format: tack list format")->required();
    exported->add_option("settings", export_.settings, "keys of the format: fps=25 objects=[cube]");
    exported->add_option("-o,--output", export_.output, "file or folder to write (default: below export in the results folder)")->type_name("FILE");
    add_plugins(*exported, export_.plugins, "formats");
    exported->callback([this] { exit_code_ = export_command(export_); });
  }

  void add_check() {
    CLI::App* check = app_.add_subcommand("check", "Validate a scene and its derivatives without running it");
    add_scene_options(*check, check_);
    add_plugins(*check, check_.plugins, "components");
    check->add_option("--gradient", check_.gradient,
                      "PROBE:KEY: run the scene and compare the sensitivity of a column of probes.csv to a scene parameter with finite differences "
                      "of whole runs");
    check->add_option("--gradient-step", check_.gradient_step, "relative increment of those differences (default: 1e-4)")->check(number_above_zero);
    check->add_option("--threads", check_.threads, "threads of those runs (default: all cores)")->check(whole_number_above_zero);
    check->add_option("--picture", check_.picture, "draw the initial state of the scene to a file (.png)")->type_name("PICTURE");
    check->callback([this] {
      settle(check_);
      exit_code_ = check_.picture.empty() ? check_command(check_) : picture_command(check_);
    });
  }

  void add_list() {
    CLI::App* list = app_.add_subcommand("list", "List the kinds and components that a scene may name, with their parameters, or search them and the documents");
    list->add_option("kind", list_.kind, "kind (energy, adhesion, minimizer, ...), name of a component, or any word to search for: 'cohesive zone'");
    list->add_option("name", list_.names, "component, to list its parameters; or further words of a search")->type_name("TEXT");
    list->add_option("--reference", list_.reference, "write the reference (Markdown): a page per kind into a folder, or one page if the path ends in .md")->type_name("FOLDER");
    list->add_option("--schema", list_.schema, "write the JSON schema of scenes (for editors) to a file")->type_name("FILE");
    list->add_option("--compare-schema", list_.compare_schema, "write the JSON schema of files of `tack compare` to a file")->type_name("FILE");
    list->add_option("--batch-schema", list_.batch_schema, "write the JSON schema of files of `tack batch` to a file")->type_name("FILE");
    list->add_option("--calibrate-schema", list_.calibrate_schema, "write the JSON schema of files of `tack calibrate` to a file")->type_name("FILE");
    list->add_option("--plot-schema", list_.plot_schema, "write the JSON schema of files of `tack plot --style` to a file")->type_name("FILE");
    list->add_option("--plugin", list_.plugins, "also list the components of this plugin (repeatable)")
        ->type_name("LIBRARY")->take_all()->allow_extra_args(false);
    list->add_option("--man", man_, "write the manual page (roff, for man) to a file")->type_name("FILE");
    list->callback([this] {
      if (!man_.empty()) replace_file(man_, man_page(command_set_of(app_)));
      exit_code_ = man_.empty() || list_.writes_files() ? list_command(list_) : exit_done;
    });
  }

  void add_law() {
    CLI::App* law = app_.add_subcommand("law", "Show an adhesion law: curves, key quantities, recommended mesh and time step, checks");
    law->add_option("words", law_.words,
                    "scene (for the laws of its pairs) or file with an adhesion law (type: ..., as below "
                    "`adhesion:`); and keys of the law or of --type: work_of_adhesion=1J/m^2")->type_name("YAML");
    law->add_option("--type", law_.type, "registered law instead of a file: tack list adhesion");
    law->add_option("--set", law_.words, "override keys of the law, as without --set: a.b=c (one or more; repeatable)")->take_all()->allow_extra_args(true);
    law->add_option("-o,--output", law_.output, "folder for pictures (SVG, PNG) and tables (CSV)")->type_name("FOLDER");
    law->add_option("--young", law_.young, "Young's modulus of the softer side, '10 MPa', for the process zone and the barrier");
    law->add_option("--speed", law_.speed, "separation speed, '1 mm/s', for the time step and the rate");
    law->add_option("--pressure", law_.pressure, "pressure under which bonds heal (default: the peak traction)");
    law->add_option("--temperature", law_.temperature, "temperature of bonds, '5 degC', of laws that depend on it (default: that of the scene, or 20 degC)");
    law->add_option("--contact-distance", law_.contact_distance, "contact distance of the barrier (default: 1 mm, or less if the law peaks below)");
    law->add_option("--barrier-stiffness", law_.barrier_stiffness, "stiffness of the barrier (default: as in scenes)");
    add_plugins(*law, law_.plugins, "laws");
    law->callback([this] { exit_code_ = law_command(law_); });
  }

  void add_mesh() {
    CLI::App* mesh = app_.add_subcommand("mesh", "Inspect, convert and process mesh files (scale, repair, remesh, tetrahedralize, unite, ...), or "
                                                 "mesh level sets");
    mesh->add_option("operation", mesh_.operation,
                     "info; convert (to another format); sdf (mesh of a level set: tack list level_set); or an operation: tack list "
                     "mesh_operation")->required();
    mesh->add_option("words", mesh_.words,
                     "mesh file (obj, ply, stl, off, glb, gltf, msh, vtk or vtu), a second one for union, difference "
                     "and intersection, and parameters of the operation: edge_length=5mm; for sdf a YAML file with "
                     "`of` and `voxel`, and overrides of its keys")->type_name("MESH");
    mesh->add_option("-o,--output", mesh_.output, "mesh file to write")->type_name("MESH");
    mesh->add_option("--object", mesh_.object, "for sdf with a scene file: the object whose shape is written");
    mesh->callback([this] { exit_code_ = mesh_command(mesh_); });
  }

  void add_completion() {
    CLI::App* completion = app_.add_subcommand("completion", "Print a completion script for a shell: commands, options and files");
    completion->add_option("shell", shell_, "bash, zsh or fish: source <(tack completion bash)")->required();
    completion->callback([this] { fmt::print("{}", completion_script(command_set_of(app_), shell_)); });
  }

  static void add_run_options(CLI::App& command, RunOptions& options) {
    add_scene_options(command, options.scene);
    add_plugins(command, options.scene.plugins, "components");
    add_output(command, options.output, options.threads);
    command.add_option("--steps", options.steps, "stop after this many steps")->check(whole_number_above_zero);
    command.add_flag("-q,--quiet", options.quiet, "print errors only");
    command.add_flag("-v,--verbose", options.verbose, "print a line for every step");
  }

  static void add_output(CLI::App& command, std::string& output, int& threads) {
    command.add_option("-o,--output", output, "results folder (default: results/NAME)")->type_name("FOLDER");
    command.add_option("--threads", threads, "threads (default: all cores)")->check(whole_number_above_zero);
  }

  CLI::App app_{"tack: adhesive contact of deformable solids by incremental potentials"};
  NewOptions new_;
  RunOptions run_, profile_;
  ViewOptions view_;
  SolveOptions solve_;
  SuiteOptions suite_;
  CompareOptions compare_;
  BatchOptions batch_;
  CalibrateOptions calibrate_;
  PlotOptions plot_;
  ReportOptions report_;
  RenderOptions render_;
  ExportOptions export_;
  CheckOptions check_;
  ListOptions list_;
  LawOptions law_;
  MeshOptions mesh_;
  std::string man_, shell_;
  int exit_code_ = exit_done;
};

}  // namespace

int execute_command_line(int argc, char** argv) { return CommandLine().execute(argc, argv); }

}  // namespace tack
