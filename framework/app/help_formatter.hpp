// Formats the help of commands: a required file is FILE in the usage line, not [file].
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tack {

// The placeholder of a required file. CLI11 may not require it: `--set` may have swallowed it.
inline constexpr const char* file_word = "file";

class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    return is_file(*option) ? "FILE" : CLI::Formatter::make_option_name(option, is_positional);
  }
  std::string make_option_usage(const CLI::Option* option) const override {
    return is_file(*option) ? "FILE" : CLI::Formatter::make_option_usage(option);
  }

 private:
  static bool is_file(const CLI::Option& option) {
    return option.get_positional() && option.get_name(true) == file_word;
  }
};

}  // namespace tack
