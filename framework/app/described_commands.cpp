#include "framework/app/described_commands.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "framework/app/scene_file_options.hpp"
#include "framework/catalogue/scene_templates.hpp"
#include "framework/contact/adhesion_law.hpp"
#include "framework/meshing/mesh_operation.hpp"
#include "framework/output/output_format.hpp"
#include "framework/output/provenance.hpp"

namespace tack {
namespace {

CommandOption described(const CLI::Option& option) {
  CommandOption o;
  for (const std::string& name : option.get_snames()) o.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) o.names.push_back("--" + name);
  o.word = option.get_positional() ? option.get_name(true) : "";
  o.about = option.get_description();
  if (option.get_items_expected_max() > 0) o.value = option.get_type_name().substr(0, option.get_type_name().find(':'));  // without its range
  o.required = option.get_required() || o.word == file_word;
  o.repeatable = option.get_items_expected_max() > 1;
  return o;
}

// Returns the names that the value of an option may take; empty: any value.
std::vector<std::string> choices_of(const std::string& command, const CommandOption& o) {
  const auto is = [&](const char* of, const std::string& which) { return command == of && (o.names.empty() ? o.word : o.names.back()) == which; };
  std::vector<std::string> names;
  if (is("completion", "shell")) names = {"bash", "zsh", "fish"};
  if (is("new", "template"))
    for (const SceneTemplate& t : scene_templates(template_folder())) names.push_back(t.name);
  if (is("list", "kind")) {
    for (const Kind* kind : registered_kinds()) names.push_back(kind->name());
    if (std::find(names.begin(), names.end(), study_kind) == names.end()) names.emplace_back(study_kind);
  }
  if (is("law", "--type")) names = Registry<AdhesionLaw>::kind().names();
  if (is("export", "--to")) names = Registry<OutputFormat>::kind().names();
  if (is("mesh", "operation")) {
    names = Registry<MeshOperation>::kind().names();
    names.insert(names.end(), {"convert", "info", "sdf"});
  }
  return names;
}

std::vector<CommandOption> options_of(const CLI::App& app) {
  std::vector<CommandOption> options;
  for (const CLI::Option* option : app.get_options()) {
    CommandOption& o = options.emplace_back(described(*option));
    o.choices = choices_of(app.get_name(), o);
  }
  return options;
}

}  // namespace

CommandSet command_set_of(const CLI::App& app) {
  CommandSet set{app.get_name(), app.get_description(), this_build().version, options_of(app), {}};
  if (set.about.starts_with("tack: ")) set.about.erase(0, 6);
  for (const CLI::App* command : app.get_subcommands({})) set.commands.push_back({command->get_name(), command->get_description(), options_of(*command)});
  return set;
}

}  // namespace tack
