// What the command line takes, as it is told by --help: completion scripts and the manual page are written from it.
#pragma once

#include <string>
#include <vector>

namespace tack {

struct CommandOption {
  std::vector<std::string> names;    // "-o", "--output"; none: a word that stands by itself
  std::string word;                  // that word: "file"
  std::string about;
  std::string value;                 // what it takes: "FOLDER", "TEXT", ...; "" for a flag
  std::vector<std::string> choices;  // of the value, where there are but some
  bool required = false, repeatable = false;
};

struct Command {
  std::string name, about;
  std::vector<CommandOption> options;
};

struct CommandSet {
  std::string name, about, version;
  std::vector<CommandOption> options;  // of the program itself
  std::vector<Command> commands;
};

// For bash, zsh or fish; InputError for another shell.
std::string completion_script(const CommandSet& set, const std::string& shell);

// tack(1), for man.
std::string man_page(const CommandSet& set);

// Endings of files that a value of that kind may be, in lower case; none: any.
std::vector<std::string> endings_of(const std::string& value);

}  // namespace tack
