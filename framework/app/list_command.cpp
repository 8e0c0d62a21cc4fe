// tack list: what can be named in a scene file; also writes the reference page and the JSON schema.
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "framework/app/commands.hpp"
#include "framework/compare/compare_config.hpp"
#include "framework/config/describe.hpp"
#include "framework/scene/scene_config.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

struct Options {
  std::string kind, name, reference, schema, compare_schema;
};

void write_text(const std::string& path, const std::string& text) {
  std::ofstream out(path);
  out << text;
  out.close();
  if (!out) throw InputError(fmt::format("cannot write '{}'; choose a folder that exists", path));
}

void list(const Options& o) {
  const std::string title = "Scene file reference";
  if (!o.reference.empty())
    write_text(o.reference, reference_page(prototype<SceneConfig>(), title) +
                                "\n## Comparison files\n\nWhat `tack compare` reads; see [comparing.md](comparing.md).\n\n" +
                                parameter_table(prototype<CompareConfig>()));
  if (!o.schema.empty())
    write_text(o.schema, json_schema(prototype<SceneConfig>(), "tack scene").dump(1) + "\n");
  if (!o.compare_schema.empty())
    write_text(o.compare_schema, json_schema(prototype<CompareConfig>(), "tack comparison").dump(1) + "\n");
  if (!o.reference.empty() || !o.schema.empty() || !o.compare_schema.empty()) return;
  if (o.kind.empty()) {
    fmt::print("{}", list_kinds());
  } else {
    fmt::print("{}", o.name.empty() ? list_kind(o.kind) : list_component(o.kind, o.name));
  }
}

}  // namespace

void add_list_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("list", "List what a scene file may name");
  command->add_option("kind", options->kind, "energy, adhesion, minimizer, ...");
  command->add_option("name", options->name, "a component, for its parameters");
  command->add_option("--reference", options->reference, "write the reference page (Markdown) to a file");
  command->add_option("--schema", options->schema, "write the JSON schema for editors to a file");
  command->add_option("--compare-schema", options->compare_schema, "the same for the files of `tack compare`");
  command->callback([options, &exit_code] {
    list(*options);
    exit_code = exit_done;
  });
}

}  // namespace tack
