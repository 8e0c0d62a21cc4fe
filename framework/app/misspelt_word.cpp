#include "framework/app/misspelt_word.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>

#include "framework/config/nearest.hpp"

namespace tack {

std::string misspelt_word(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = nullptr;
  for (const std::string& word : words) {
    if (!command && !word.starts_with('-')) {
      std::vector<std::string> names;
      for (const CLI::App* one : app.get_subcommands({})) {
        names.push_back(one->get_name());
        if (one->get_name() == word) command = one;
      }
      if (!command) return fmt::format("unknown command '{}'{}", word, suggestion(word, names, "commands"));
    }
    if (word.size() < 2 || !word.starts_with('-') || std::isdigit(static_cast<unsigned char>(word[1]))) continue;
    std::vector<std::string> names;
    for (const CLI::Option* option : (command ? *command : app).get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
      for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    }
    const std::string name = word.substr(0, word.find('='));
    const bool known = std::any_of(names.begin(), names.end(), [&](const std::string& n) {
      return n == name || (n.size() == 2 && !name.starts_with("--") && name.starts_with(n));  // -oDIR
    });
    if (!known && name == "--plugin")
      return fmt::format(
          "`tack{}` takes no --plugin: the file names the library under `plugins`, or --set "
          "plugins=[LIBRARY] does",
          command ? " " + command->get_name() : "");
    if (!known)
      return fmt::format("unknown option '{}' of `tack{}`{}", name,
                         command ? " " + command->get_name() : "",
                         suggestion(name, names, "options"));
  }
  return "";
}

}  // namespace tack
