// The commands and options of the command line, as --help prints them. Source of the completion
// scripts and of the manual page.
#pragma once

#include <string>
#include <vector>

namespace tack {

struct CommandOption {
  std::vector<std::string> names;  // "-o", "--output"; empty: positional
  std::string word;                // placeholder of the positional argument: "file"
  std::string about;
  // Placeholder of the value: "FOLDER", "TEXT", ...; "" for a flag.
  std::string value;
  std::vector<std::string> choices;  // allowed values; empty: any value
  bool required = false, repeatable = false;
};

struct Command {
  std::string name, about;
  std::vector<CommandOption> options;
};

struct CommandSet {
  std::string name, about, version;
  std::vector<CommandOption> options;  // options of the program itself
  std::vector<Command> commands;
};

// Returns the completion script for bash, zsh or fish. Throws InputError for another shell.
std::string completion_script(const CommandSet& set, const std::string& shell);

// Returns the manual page tack(1) as roff.
std::string man_page(const CommandSet& set);

// Returns the file name endings, in lower case, that complete a value with this placeholder; empty:
// any file.
std::vector<std::string> endings_of(const std::string& value);

}  // namespace tack
