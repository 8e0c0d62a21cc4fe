// The commands, their options and what is told of them. CLI11 is known here and in number_options.hpp alone.
#include "framework/app/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "framework/app/command_set.hpp"
#include "framework/app/commands.hpp"
#include "framework/app/number_options.hpp"
#include "framework/config/nearest.hpp"
#include "framework/contact/adhesion_law.hpp"
#include "framework/meshing/mesh_operation.hpp"
#include "framework/output/provenance.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command.add_option("file", options.file, "the experiment (YAML); required")->type_name("YAML");
  command.add_option("--set", options.overrides, "override keys: a.b=c (one or more; repeatable)")
      ->take_all()->allow_extra_args(true);
}

// --set takes several values and so also a file that stands behind them: what has no '=' is the file.
void settle(SceneOptions& options) {
  if (!options.file.empty()) return;
  std::vector<std::string>& values = options.overrides;
  const auto file = std::find_if(values.begin(), values.end(), [](const std::string& value) {
    return value.find('=') == std::string::npos;
  });
  if (file == values.end()) throw CLI::RequiredError("file");
  options.file = *file;
  values.erase(file);
}

std::string version_text() {
  const Build build = this_build();
  return fmt::format("tack {} ({})\n{}, {}; {}", build.version, build.sources(), build.compiler, build.flags, build.instruction_set);
}

// Every command adds itself and, when chosen, sets the exit code.
class CommandLine {
 public:
  CommandLine() {
    app_.name("tack");
    app_.set_version_flag("--version", version_text());
    app_.require_subcommand(1);
    app_.footer("`./tack test` runs the tests.");
    add_run();
    add_view();
    add_profile();
    add_compare();
    add_batch();
    add_calibrate();
    add_plot();
    add_report();
    add_render();
    add_check();
    add_list();
    add_law();
    add_mesh();
    add_completion();
  }

  int execute(int argc, char** argv) {
    run_.command_line = view_.command_line = profile_.command_line = compare_.command_line = batch_.command_line = calibrate_.command_line =
        shell_line({argv, argv + argc});
    if (argc < 2) {
      fmt::print(stderr, "{}", app_.help());
      return exit_bad_input;
    }
    std::vector<std::string> words = as_options({argv + 1, argv + argc});
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    try {
      app_.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
      if (const std::string what = misspelt({argv + 1, argv + argc}); error.get_exit_code() != 0 && !what.empty()) throw InputError(what);
      return app_.exit(error) == 0 ? exit_done : exit_bad_input;
    }
    return exit_code_;
  }

 private:
  // `tack help run` and `tack version`, as other programs have them.
  static std::vector<std::string> as_options(std::vector<std::string> words) {
    if (words[0] == "version" && words.size() == 1) words[0] = "--version";
    if (words[0] != "help") return words;
    words.erase(words.begin());
    words.emplace_back("--help");
    return words;
  }

  // Which word of a command line that does not fit is no command or no option, and what may have been meant; "" if none.
  std::string misspelt(const std::vector<std::string>& words) const {
    const CLI::App* command = nullptr;
    for (const std::string& word : words) {
      if (!command && !word.starts_with('-')) {
        std::vector<std::string> names;
        for (const CLI::App* one : app_.get_subcommands({})) {
          names.push_back(one->get_name());
          if (one->get_name() == word) command = one;
        }
        if (!command) return fmt::format("unknown command '{}'{}", word, suggestion(word, names, "commands"));
      }
      if (word.size() < 2 || !word.starts_with('-') || std::isdigit(static_cast<unsigned char>(word[1]))) continue;
      std::vector<std::string> names;
      for (const CLI::Option* option : (command ? *command : app_).get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        for (const std::string& name : option->get_snames()) names.push_back("-" + name);
      }
      const std::string name = word.substr(0, word.find('='));
      const bool known = std::any_of(names.begin(), names.end(), [&](const std::string& n) {
        return n == name || (n.size() == 2 && !name.starts_with("--") && name.starts_with(n));  // -oDIR
      });
      if (!known) return fmt::format("unknown option '{}' of `tack{}`{}", name, command ? " " + command->get_name() : "", suggestion(name, names, "options"));
    }
    return "";
  }

  void add_run() {
    CLI::App* run = app_.add_subcommand("run", "Simulate an experiment");
    add_run_options(*run, run_);
    run->add_flag("--resume", run_.resume, "go on from the newest checkpoint of the results folder");
    run->add_option("--memory", run_.memory, "GB that it may have (default: any); a run that needs more fails")->check(number_above_zero);
    run->add_option("--dump-problem", run_.dump_problems,
                    "store a step to minimise it again: step=K, or hardest=N for those with most iterations (repeatable)")
        ->take_all()->allow_extra_args(false);
    run->callback([this] {
      settle(run_.scene);
      exit_code_ = run_command(run_);
    });
  }

  void add_view() {
    CLI::App* view = app_.add_subcommand("view", "Look at a scene before or while it is run, or at results, in a browser on this machine");
    add_run_options(*view, view_);
    view->get_option("file")->description("the experiment (YAML), or a folder of results; required");
    view->get_option("--output")
        ->description("of a scene or of results: the file (.html) to write, and nothing is served; with --run: results folder (default: results/NAME)")->type_name("FILE");
    CLI::Option* run = view->add_flag("--run", view_.run, "run it, and show frames and curves as they come, with buttons to pause and to stop");
    for (const char* name : {"--threads", "--steps", "--quiet", "--verbose"}) view->get_option(name)->needs(run);
    view->add_flag("--resume", view_.resume, "with --run: go on from the newest checkpoint of the results folder")->needs(run);
    view->add_flag("--no-browser", view_.no_browser, "print the address only");
    view->callback([this] {
      settle(view_.scene);
      exit_code_ = view_command(view_);
    });
  }

  void add_profile() {
    CLI::App* profile = app_.add_subcommand("profile", "Simulate an experiment and tell what costs what, and what to change");
    add_run_options(*profile, profile_);
    profile->callback([this] {
      settle(profile_.scene);
      profile_.profile = true;
      exit_code_ = run_command(profile_);
    });
  }

  void add_compare() {
    CLI::App* compare = app_.add_subcommand("compare", "Measure speed against error of several solvers");
    add_scene_options(*compare, compare_.file);
    add_output(*compare, compare_.output, compare_.threads);
    compare->add_flag("-q,--quiet", compare_.quiet, "print errors only");
    compare->callback([this] {
      settle(compare_.file);
      exit_code_ = compare_command(compare_);
    });
  }

  void add_batch() {
    CLI::App* batch = app_.add_subcommand("batch", "Run many experiments side by side, and make one table of them");
    add_scene_options(*batch, batch_.file);
    add_output(*batch, batch_.output, batch_.threads);
    batch->add_option("--jobs", batch_.jobs, "cases side by side (default: as many as cores allow)")->check(whole_number_above_zero);
    batch->add_flag("--dry-run", batch_.dry_run, "check all cases, show them and how long they will take");
    batch->add_flag("--failed", batch_.failed, "run those again that failed");
    batch->add_option("--only", batch_.only, "run these cases alone, by their names as --dry-run shows them; * is any text")->type_name("CASE");
    CLI::Option* slurm = batch->add_flag("--slurm", batch_.slurm, "run the cases as a job array of Slurm");
    batch->add_flag("--no-wait", batch_.no_wait, "with --slurm: do not wait for the end")->needs(slurm);
    batch->add_option("--collect", batch_.collect, "make the table of a batch's folder again, and run nothing")->type_name("FOLDER");
    batch->add_option("--task", batch_.task, "only this case, from 0, of the batch in the folder -o: what a job array runs");
    batch->add_flag("-q,--quiet", batch_.quiet, "print errors only");
    batch->callback([this] {
      if (batch_.task && batch_.output.empty()) throw CLI::RequiredError("--task: -o");
      if (!batch_.task && batch_.collect.empty()) settle(batch_.file);
      exit_code_ = batch_command(batch_);
    });
  }

  void add_calibrate() {
    CLI::App* calibrate = app_.add_subcommand("calibrate", "Fit numbers of experiments to measured curves");
    add_scene_options(*calibrate, calibrate_.file);
    add_output(*calibrate, calibrate_.output, calibrate_.threads);
    calibrate->add_option("--jobs", calibrate_.jobs, "runs side by side (default: as many as cores allow)")->check(whole_number_above_zero);
    calibrate->add_flag("--dry-run", calibrate_.dry_run, "check everything, and say how long it will take");
    calibrate->add_flag("--failed", calibrate_.failed, "run those again that failed");
    calibrate->add_flag("--slurm", calibrate_.slurm, "run what is wanted at once as job arrays of Slurm");
    calibrate->add_flag("-q,--quiet", calibrate_.quiet, "print errors only");
    calibrate->callback([this] {
      settle(calibrate_.file);
      exit_code_ = calibrate_command(calibrate_);
    });
  }

  void add_plot() {
    CLI::App* plot = app_.add_subcommand("plot", "Draw pictures (SVG, PNG) of runs, a batch or a comparison");
    plot->add_option("folder", plot_.folders, "results folders: of runs, or of one batch or comparison")->required()->type_name("FOLDER");
    plot->add_option("-o,--output", plot_.output, "folder of the pictures (default: plots in the folder; of several, here)")->type_name("FOLDER");
    CLI::Option* x = plot->add_option("--x", plot_.x, "along the axis: of runs a probe or time, of a batch a column of results.csv");
    CLI::Option* y = plot->add_option("--y", plot_.y, "what is shown over it")->needs(x);
    x->needs(y);
    plot->add_option("--by", plot_.by, "of a batch: a curve for each value of this column (repeatable; default: all else that varies)")
        ->take_all()->allow_extra_args(false)->needs(x);
    plot->add_flag("--log-x", plot_.log_x, "a logarithmic axis")->needs(x);
    plot->add_option("--x-range", plot_.x_range, "from and to what is shown, in SI")->expected(2)->needs(x);
    plot->add_option("--data", plot_.data, "a file (CSV, with units) with columns of the same names, drawn as marks (repeatable)")
        ->type_name("CSV")->take_all()->allow_extra_args(false)->needs(x);
    plot->add_flag("--log-y", plot_.log_y, "a logarithmic axis")->needs(x);
    plot->add_option("--style", plot_.style, "a file (YAML) with size on paper, fonts, labels, colours; PDF as well")->type_name("YAML");
    plot->add_option("--set", plot_.overrides, "override keys of the style: a.b=c (one or more; repeatable)")->take_all()->allow_extra_args(true);
    plot->callback([this] { exit_code_ = plot_command(plot_); });
  }

  void add_report() {
    CLI::App* report = app_.add_subcommand("report", "Make one HTML file of a run, several runs, a comparison or a batch: charts, tables, 3D view");
    report->add_option("folder", report_.folders, "results folders: of runs, or of one comparison or batch")->required()->type_name("FOLDER");
    report->add_option("-o,--output", report_.output, "the file to write (default: report.html in the folder; of several, here)")->type_name("FILE");
    report->add_option("--frames", report_.frames, "frames to keep (default: 200, fewer of large meshes)")->check(whole_number_above_zero);
    report->add_option("--case", report_.cases, "of a batch: a case whose run is shown as well (repeatable)")
        ->take_all()->allow_extra_args(false);
    report->callback([this] { exit_code_ = report_command(report_); });
  }

  void add_render() {
    CLI::App* render = app_.add_subcommand("render", "Draw a picture (PNG) or a film (MP4, GIF) of runs, side by side, with shadows");
    render->add_option("folder", render_.folders, "results folders of runs")->required()->type_name("FOLDER");
    render->add_option("-o,--output", render_.output, "the file: its ending says what it is")->type_name("PICTURE")->capture_default_str();
    render->add_option("--view", render_.view, "a file (YAML) with size, camera, looks of objects, colours by a field")->type_name("YAML");
    render->add_option("--set", render_.overrides, "override keys of the view: a.b=c (one or more; repeatable)")->take_all()->allow_extra_args(true);
    render->add_flag("-q,--quiet", render_.quiet, "print errors only");
    render->callback([this] { exit_code_ = render_command(render_); });
  }

  void add_check() {
    CLI::App* check = app_.add_subcommand("check", "Validate an experiment without running it");
    add_scene_options(*check, check_);
    check->add_option("--gradient", check_.gradient,
                      "PROBE:KEY: run it, and compare the derivative of a column of probes.csv by a number of the scene with differences of whole runs");
    check->add_option("--gradient-step", check_.gradient_step, "of those differences, relative (default: 1e-4)")->check(number_above_zero);
    check->add_option("--threads", check_.threads, "of those runs (default: all cores)")->check(whole_number_above_zero);
    check->callback([this] {
      settle(check_);
      exit_code_ = check_command(check_);
    });
  }

  void add_list() {
    CLI::App* list = app_.add_subcommand("list", "List what a scene file may name");
    list->add_option("kind", list_.kind, "energy, adhesion, minimizer, ...");
    list->add_option("name", list_.name, "a component, for its parameters");
    list->add_option("--reference", list_.reference, "write the reference (Markdown): a page per kind into a folder, or one page if the path ends in .md")->type_name("FOLDER");
    list->add_option("--schema", list_.schema, "write the JSON schema for editors to a file")->type_name("FILE");
    list->add_option("--compare-schema", list_.compare_schema, "the same for the files of `tack compare`")->type_name("FILE");
    list->add_option("--batch-schema", list_.batch_schema, "the same for the files of `tack batch`")->type_name("FILE");
    list->add_option("--calibrate-schema", list_.calibrate_schema, "the same for the files of `tack calibrate`")->type_name("FILE");
    list->add_option("--plot-schema", list_.plot_schema, "the same for the files of `tack plot --style`")->type_name("FILE");
    list->add_option("--plugin", list_.plugins, "list (and describe) what a plugin adds as well (repeatable)")
        ->type_name("LIBRARY")->take_all()->allow_extra_args(false);
    list->add_option("--man", man_, "write the manual page (roff, for man) to a file")->type_name("FILE");
    list->callback([this] {
      if (!man_.empty()) replace_file(man_, man_page(described()));
      exit_code_ = man_.empty() || list_.writes_files() ? list_command(list_) : exit_done;
    });
  }

  void add_law() {
    CLI::App* law = app_.add_subcommand("law", "Show adhesion laws by themselves: curves, figures, what they ask of a scene, checks");
    law->add_option("words", law_.words,
                    "a scene, for the laws of its pairs, or the file of an adhesion (type: ..., as below `adhesion:`); and keys of it, or of --type: "
                    "work_of_adhesion=1J/m^2")->type_name("YAML");
    law->add_option("--type", law_.type, "a registered law instead of a file: ./tack list adhesion");
    law->add_option("--set", law_.words, "the same as keys without it: a.b=c (one or more; repeatable)")->take_all()->allow_extra_args(true);
    law->add_option("-o,--output", law_.output, "folder for pictures (SVG, PNG) and tables (CSV)")->type_name("FOLDER");
    law->add_option("--young", law_.young, "Young's modulus of the softer side, '10 MPa', for the process zone and the barrier");
    law->add_option("--speed", law_.speed, "at which surfaces part, '1 mm/s', for the time step and the rate");
    law->add_option("--pressure", law_.pressure, "under which bonds heal (default: the peak traction)");
    law->add_option("--contact-distance", law_.contact_distance, "of the barrier (default: 1 mm, or less if the law pulls most below)");
    law->add_option("--barrier-stiffness", law_.barrier_stiffness, "of the barrier (default: as in scenes)");
    law->add_option("--plugin", law_.plugins, "a library with laws of your own (repeatable)")->type_name("LIBRARY")->take_all()->allow_extra_args(false);
    law->callback([this] { exit_code_ = law_command(law_); });
  }

  void add_mesh() {
    CLI::App* mesh = app_.add_subcommand("mesh", "Look at mesh files and change them (convert, scale, repair, remesh, fill with tets, unite, ...), make them of level sets");
    mesh->add_option("operation", mesh_.operation,
                     "info; convert, to another format; an operation: ./tack list mesh_operation; or sdf, the surface of a level set: ./tack list level_set")->required();
    mesh->add_option("words", mesh_.words,
                     "the mesh file (obj, ply, stl, off, glb, gltf, msh, vtk or vtu), for union, difference and intersection another one, and "
                     "parameters of the operation: edge_length=5mm; for sdf a YAML file with `of` and `voxel`, and overrides of its keys")->type_name("MESH");
    mesh->add_option("-o,--output", mesh_.output, "the mesh file to write")->type_name("MESH");
    mesh->add_option("--object", mesh_.object, "for sdf: the file is an experiment, and this the object whose shape is written");
    mesh->callback([this] { exit_code_ = mesh_command(mesh_); });
  }

  void add_completion() {
    CLI::App* completion = app_.add_subcommand("completion", "Print a script with which a shell completes commands, options and files");
    completion->add_option("shell", shell_, "bash, zsh or fish: source <(tack completion bash)")->required();
    completion->callback([this] { fmt::print("{}", completion_script(described(), shell_)); });
  }

  static CommandOption described(const CLI::Option& option) {
    CommandOption o;
    for (const std::string& name : option.get_snames()) o.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) o.names.push_back("--" + name);
    o.word = option.get_positional() ? option.get_name(true) : "";
    o.about = option.get_description();
    if (option.get_items_expected_max() > 0) o.value = option.get_type_name().substr(0, option.get_type_name().find(':'));  // without its range
    o.required = option.get_required();
    o.repeatable = option.get_items_expected_max() > 1;
    return o;
  }

  // Values that are names are those that are registered.
  static std::vector<std::string> choices_of(const std::string& command, const CommandOption& o) {
    const auto is = [&](const char* of, const std::string& which) { return command == of && (o.names.empty() ? o.word : o.names.back()) == which; };
    std::vector<std::string> names;
    if (is("completion", "shell")) names = {"bash", "zsh", "fish"};
    if (is("list", "kind"))
      for (const Kind* kind : registered_kinds()) names.push_back(kind->name());
    if (is("law", "--type")) names = Registry<AdhesionLaw>::kind().names();
    if (is("mesh", "operation")) {
      names = Registry<MeshOperation>::kind().names();
      names.insert(names.end(), {"convert", "info", "sdf"});
    }
    return names;
  }

  static std::vector<CommandOption> options_of(const CLI::App& app) {
    std::vector<CommandOption> options;
    for (const CLI::Option* option : app.get_options()) {
      CommandOption& o = options.emplace_back(described(*option));
      o.choices = choices_of(app.get_name(), o);
    }
    return options;
  }

  CommandSet described() const {
    CommandSet set{app_.get_name(), app_.get_description(), this_build().version, options_of(app_), {}};
    if (set.about.starts_with("tack: ")) set.about.erase(0, 6);
    for (const CLI::App* command : app_.get_subcommands({})) set.commands.push_back({command->get_name(), command->get_description(), options_of(*command)});
    return set;
  }

  static void add_run_options(CLI::App& command, RunOptions& options) {
    add_scene_options(command, options.scene);
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
  RunOptions run_, profile_;
  ViewOptions view_;
  CompareOptions compare_;
  BatchOptions batch_;
  CalibrateOptions calibrate_;
  PlotOptions plot_;
  ReportOptions report_;
  RenderOptions render_;
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
