// A scratch folder that disappears with the test, and the output of a call.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

namespace tack {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tack_test_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// Sends the descriptors of stdout and stderr to a file for as long as it lives.
class Redirection {
 public:
  explicit Redirection(const std::filesystem::path& log) : out_(::dup(1)), err_(::dup(2)) {
    flush();
    const int file = ::open(log.c_str(), O_CREAT | O_WRONLY | O_APPEND, 0600);
    ::dup2(file, 1);
    ::dup2(file, 2);
    ::close(file);
  }
  ~Redirection() {
    flush();
    ::dup2(out_, 1);
    ::dup2(err_, 2);
    ::close(out_);
    ::close(err_);
  }
  Redirection(const Redirection&) = delete;
  Redirection& operator=(const Redirection&) = delete;

 private:
  static void flush() {
    std::cout.flush();
    std::fflush(nullptr);
  }

  int out_, err_;
};

// Everything that is printed while `work` runs.
template <class Work>
std::string printed_by(const Work& work) {
  const TemporaryFolder folder;
  const std::filesystem::path log = folder.path() / "printed";
  {
    const Redirection redirection(log);
    work();
  }
  std::ostringstream text;
  text << std::ifstream(log).rdbuf();
  return text.str();
}

}  // namespace tack
