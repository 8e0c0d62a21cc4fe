// Scripts that complete commands, options and files in shells.
#include <fmt/format.h>

#include "framework/app/command_set.hpp"
#include "framework/meshing/mesh_operation.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

template <class Each>
std::string lines_of(const std::vector<Command>& commands, const Each& each) {
  std::string text;
  for (const Command& c : commands) text += each(c);
  return text;
}

std::vector<std::string> names_of(const std::vector<Command>& commands) {
  std::vector<std::string> names;
  for (const Command& c : commands) names.push_back(c.name);
  return names;
}

std::vector<std::string> option_names(const std::vector<CommandOption>& options) {
  std::vector<std::string> names;
  for (const CommandOption& o : options) names.insert(names.end(), o.names.begin(), o.names.end());
  return names;
}

std::string joined(const std::vector<std::string>& words, const char* between = " ") { return fmt::format("{}", fmt::join(words, between)); }

// Quotes a text for a shell with single quotes.
std::string quoted(std::string text) {
  for (size_t at = 0; (at = text.find('\'', at)) != text.npos; at += 4) text.replace(at, 1, "'\\''");
  return "'" + text + "'";
}

// Returns the shell code that completes the value of an option: a call of a function of the script.
std::string bash_value(const CommandOption& o) {
  if (!o.choices.empty()) return fmt::format("_tack_words {}", quoted(joined(o.choices)));
  if (o.value == "FOLDER") return "_tack_files";
  const std::vector<std::string> endings = endings_of(o.value);
  if (!endings.empty()) return "_tack_files " + joined(endings);
  return o.value == "FILE" ? "_tack_files '*'" : ":";
}

std::string bash_keys() {
  std::string cases;
  const Kind& kind = Registry<MeshOperation>::kind();
  for (const std::string& name : kind.names()) {
    const Fields fields = kind.prototype(name);
    std::vector<std::string> keys;
    for (const std::string& key : fields.keys()) keys.push_back(key + "=");
    cases += fmt::format("    {}) _tack_words {}; _tack_no_space ;;\n", name, quoted(joined(keys)));
  }
  return cases + "    convert) _tack_words 'from= to= surface=true'; _tack_no_space ;;\n";
}

std::string bash_names() {
  std::string cases;
  for (const Kind* kind : registered_kinds()) cases += fmt::format("    {}) _tack_words {} ;;\n", kind->name(), quoted(joined(kind->names())));
  return cases;
}

std::string bash_script(const CommandSet& set) {
  std::string values, words, takers;
  for (const Command& c : set.commands) {
    std::vector<std::string> own;
    for (const CommandOption& o : c.options) {
      if (o.names.empty()) own.push_back(bash_value(o));
      else if (!o.value.empty()) {
        std::vector<std::string> patterns;
        for (const std::string& name : o.names) patterns.push_back(quoted(c.name + " " + name));
        values += fmt::format("    {}) {}; return ;;\n", joined(patterns, " | "), bash_value(o));
        takers += (takers.empty() ? "" : " | ") + joined(patterns, " | ");
      }
    }
    std::string cases;
    for (size_t i = 0; i < own.size(); ++i) cases += i + 1 < own.size() ? fmt::format("if ((count == {})); then {}; else ", i, own[i]) : own[i];
    for (size_t i = 0; i + 1 < own.size(); ++i) cases += "; fi";
    if (c.name == "mesh") cases += "; ((count == 0)) || _tack_mesh_keys \"${words[0]}\"";
    if (c.name == "list") cases += "; ((count != 1)) || _tack_list_names \"${words[0]}\"";
    words += fmt::format("    {}) {} ;;\n", c.name, cases.empty() ? ":" : cases);
  }
  return fmt::format(R"script(# bash completion of tack; made by `tack completion bash`. Kept: source it, or put it into share/bash-completion/completions/tack.
_tack_words() {{
  COMPREPLY+=($(compgen -W "$1" -- "$cur"))
}}
_tack_no_space() {{
  [[ ${{COMPREPLY-}} != *= ]] || compopt -o nospace 2>/dev/null
}}
# Folders, and files with one of the endings.
_tack_files() {{
  local IFS=$'\n' one ending
  compopt -o filenames 2>/dev/null
  for one in $(compgen -f -- "$cur"); do
    if [[ -d $one ]]; then
      COMPREPLY+=("$one")
      continue
    fi
    for ending in "$@"; do [[ $ending != '*' && ${{one,,}} != *."$ending" ]] || COMPREPLY+=("$one"); done
  done
}}
_tack_mesh_keys() {{
  case $1 in
{keys}  esac
}}
_tack_list_names() {{
  case $1 in
{names}  esac
}}
_tack_takes_value() {{
  case $1 in
    {takers}) return 0 ;;
  esac
  return 1
}}
_tack() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command= count=0 i
  local words=()
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    if [[ -z $command ]]; then
      [[ ${{COMP_WORDS[i]}} == -* ]] || command=${{COMP_WORDS[i]}}
    elif [[ ${{COMP_WORDS[i]}} != [-=]* && ${{COMP_WORDS[i-1]}} != = ]] && ! _tack_takes_value "$command ${{COMP_WORDS[i-1]}}"; then
      words+=("${{COMP_WORDS[i]}}")
    fi
  done
  count=${{#words[@]}}
  if [[ -z $command ]]; then
    _tack_words {commands}
    return
  fi
  [[ $cur != = && $before != = ]] || return
  case "$command $before" in
{values}  esac
  if [[ $cur == -* ]]; then
    case $command in
{options}    esac
    return
  fi
  case $command in
{words}  esac
}}
complete -F _tack tack
)script",
                     fmt::arg("keys", bash_keys()), fmt::arg("names", bash_names()),
                     fmt::arg("commands", quoted(joined(names_of(set.commands)) + " " + joined(option_names(set.options)))), fmt::arg("values", values), fmt::arg("takers", takers),
                     fmt::arg("options", lines_of(set.commands, [](const Command& c) {
                                return fmt::format("    {}) _tack_words {} ;;\n", c.name, quoted(joined(option_names(c.options))));
                              })),
                     fmt::arg("words", words));
}

// Escapes a text for _arguments, whose fields must not contain ':' or brackets.
std::string zsh_text(std::string text) {
  for (const char c : {':', '[', ']'})
    for (size_t at = 0; (at = text.find(c, at)) != text.npos; at += 2) text.insert(at, "\\");
  return text;
}

std::string zsh_value(const CommandOption& o) {
  if (!o.choices.empty()) return "(" + joined(o.choices) + ")";
  if (o.value == "FOLDER") return "_files -/";
  const std::vector<std::string> endings = endings_of(o.value);
  if (!endings.empty()) return fmt::format("_files -g \"(#i)*.({})\"", joined(endings, "|"));
  return o.value == "FILE" ? "_files" : " ";
}

std::string zsh_option(const CommandOption& o, size_t place) {
  if (o.names.empty()) return fmt::format("'{}:{}:{}'", o.repeatable ? "*" : std::to_string(place), zsh_text(o.word), zsh_value(o));
  std::string text;
  for (const std::string& name : o.names) {
    const std::string about = quoted(fmt::format("{}{}[{}]{}", o.repeatable ? "*" : "", name, zsh_text(o.about), o.value.empty() ? "" : ":" + o.value + ":" + zsh_value(o)));
    text += (text.empty() ? "" : " ") + about;
  }
  return text;
}

std::string zsh_script(const CommandSet& set) {
  std::string commands, arguments;
  for (const Command& c : set.commands) {
    commands += fmt::format("    {}\n", quoted(c.name + ":" + zsh_text(c.about)));
    arguments += fmt::format("    {})\n      _arguments", c.name);
    size_t place = 1;
    for (const CommandOption& o : c.options) arguments += " \\\n        " + zsh_option(o, o.names.empty() ? place++ : 0);
    arguments += "\n      ;;\n";
  }
  return fmt::format(R"script(#compdef tack
# zsh completion of tack; made by `tack completion zsh`. Kept: as _tack in a folder of $fpath.
_tack() {{
  local -a commands
  commands=(
{}  )
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  ((--CURRENT))
  case $command in
{}  esac
}}
if [[ $funcstack[1] == _tack ]]; then _tack "$@"; else compdef _tack tack; fi
)script",
                     commands, arguments);
}

std::string fish_script(const CommandSet& set) {
  std::string text = "# fish completion of tack; made by `tack completion fish`. Kept: as completions/tack.fish in fish's folder.\ncomplete -c tack -f\n";
  for (const Command& c : set.commands) {
    text += fmt::format("complete -c tack -n __fish_use_subcommand -a {} -d {}\n", c.name, quoted(c.about));
    const std::string condition = fmt::format("complete -c tack -n '__fish_seen_subcommand_from {}'", c.name);
    for (const CommandOption& o : c.options) {
      std::string line = condition;
      for (const std::string& name : o.names) line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      const std::vector<std::string> endings = endings_of(o.value);
      std::vector<std::string> suffixes;
      for (const std::string& e : endings) suffixes.push_back(fmt::format("(__fish_complete_suffix .{})", e));
      std::string values = !o.choices.empty() ? joined(o.choices) : o.value == "FOLDER" ? "(__fish_complete_directories)" : joined(suffixes);
      if (!o.names.empty() && !o.value.empty()) line += o.value == "FILE" ? " -r -F" : " -r";
      if (o.names.empty() && values.empty()) continue;
      if (!values.empty()) line += " -a " + quoted(values);
      text += line + " -d " + quoted(o.names.empty() ? o.word : o.about) + "\n";
    }
  }
  return text;
}

}  // namespace

std::vector<std::string> endings_of(const std::string& value) {
  if (value == "YAML") return {"yaml", "yml"};
  if (value == "MESH") return {"obj", "ply", "stl", "off", "glb", "gltf", "msh", "vtk", "vtu", "yaml"};
  if (value == "PROBLEM") return {"problem"};
  if (value == "CSV") return {"csv"};
  if (value == "LIBRARY") return {"so"};
  if (value == "PICTURE") return {"png", "mp4", "gif"};
  return {};
}

std::string completion_script(const CommandSet& set, const std::string& shell) {
  if (shell == "bash") return bash_script(set);
  if (shell == "zsh") return zsh_script(set);
  if (shell == "fish") return fish_script(set);
  throw InputError(fmt::format("no completion for the shell '{}'; there are: bash, zsh, fish", shell));
}

}  // namespace tack
