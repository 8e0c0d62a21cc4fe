// Runs the built program as its users do: a process of its own, in a folder of its own.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/silence.hpp"

namespace tack {

using Arguments = std::vector<std::string>;

struct ProgramResult {
  int exit_code = -1;  // -1: ended by a signal, or not in time
  std::string out, err;
};

class Program {
 public:
  // Starts `tack arguments...` in a working directory.
  Program(const std::filesystem::path& directory, const Arguments& arguments,
          const std::string& program = TACK_PROGRAM);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void interrupt();                       // as Ctrl-C does
  void terminate();                       // as `kill` does
  void hang_up();                         // as the end of its terminal does
  bool has_child() const;                 // whether it has forked a process that runs
  int threads_open_to(int signal) const;  // that do not block it
  void kill();                            // as `kill -9` does
  // Kills it after `patience`, with sanitizers after twenty times that.
  ProgramResult wait(std::chrono::minutes patience = std::chrono::minutes(4));

 private:
  TemporaryFolder printed_;
  pid_t pid_ = -1;
};

ProgramResult run_tack(const std::filesystem::path& directory, const Arguments& arguments,
                       const std::string& program = TACK_PROGRAM,
                       std::chrono::minutes patience = std::chrono::minutes(4));

// Returns the text of a file; "" if there is no file.
std::string file_text(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& text);
bool contains(const std::string& text, const std::string& part);

}  // namespace tack
