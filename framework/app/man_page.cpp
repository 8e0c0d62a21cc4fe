// tack(1): roff with the macros of man(7).
#include <fmt/format.h>

#include "framework/app/command_set.hpp"
#include "framework/app/commands.hpp"

namespace tack {
namespace {

// Escapes a text for roff: backslashes, hyphens, and lines that begin like a request.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') out += "\\e";
    else if (c == '-') out += "\\-";
    else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) out += std::string("\\&") + c;
    else out += c;
  }
  return out;
}

std::string options_text(const std::vector<CommandOption>& options) {
  std::string text;
  for (const CommandOption& o : options) {
    std::string head;
    for (const std::string& name : o.names) head += (head.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
    if (o.names.empty()) head = "\\fI" + roff(o.word) + "\\fR";
    else if (!o.value.empty()) head += " \\fI" + roff(o.value) + "\\fR";
    if (o.repeatable) head += " ...";
    text += fmt::format(".TP\n{}\n{}\n", head, roff(o.about));
    if (!o.choices.empty()) {
      text += "One of:\n";
      for (size_t i = 0; i < o.choices.size(); ++i) text += roff(o.choices[i]) + (i + 1 < o.choices.size() ? ",\n" : ".\n");
    }
  }
  return text;
}

std::string synopsis_of(const Command& c) {
  std::string text = fmt::format(".SY \"tack {}\"\n.RI [ options ]\n", c.name);
  for (const CommandOption& o : c.options)
    if (o.names.empty())
      text += o.required ? fmt::format(".I {}{}\n", roff(o.word), o.repeatable ? " ..." : "") : fmt::format(".RI [ {} ]{}\n", roff(o.word), o.repeatable ? " ..." : "");
  return text + ".YS\n";
}

}  // namespace

std::string man_page(const CommandSet& set) {
  std::string page = fmt::format(".\\\" Made by `tack list --man`.\n.TH TACK 1 \"\" \"tack {}\" \"User Commands\"\n.SH NAME\ntack \\- {}\n.SH SYNOPSIS\n", roff(set.version),
                                 roff(set.about));
  for (const Command& c : set.commands) page += synopsis_of(c);
  page += ".SH DESCRIPTION\nA scene is a YAML file. It says what there is, how it touches, how it is held, which probes are written and what its run must show.\n"
          ".B tack run\nsimulates it and writes a folder of results; the other commands check, compare, vary, fit and draw.\n"
          ".SH OPTIONS\n" + options_text(set.options) + ".SH COMMANDS\n";
  for (const Command& c : set.commands) page += fmt::format(".SS tack {}\n{}.\n{}", c.name, roff(c.about), options_text(c.options));
  page += fmt::format(
      ".SH EXIT STATUS\n.TP\n{}\ndone\n.TP\n{}\nan expectation of the scene failed\n.TP\n{}\nthe input is wrong: nothing was done\n.TP\n{}\nthe simulation, or what it needs, failed\n"
      ".TP\n{}\ninterrupted\n",
      exit_done, exit_expectation_failed, exit_bad_input, exit_simulation_failed, exit_interrupted);
  page += ".SH ENVIRONMENT\n.TP\n.B TACK_MESHES\nthe folder in which meshes that take long to make are kept (default: results/meshes); none: nowhere\n"
          ".TP\n.B TACK_ARCHITECTURE\nof a package: which of the installed programs is run, x86\\-64, x86\\-64\\-v3 or x86\\-64\\-v4, instead of the best for the processor\n"
          ".SH SEE ALSO\nThe pages in share/tack/docs, where tack is installed, and\n.B tack list\nfor all that a scene may name.\n";
  return page;
}

}  // namespace tack
