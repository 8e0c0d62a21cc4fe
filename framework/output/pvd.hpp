// run.pvd: the list of a run's frames with their times, which ParaView opens as an animation.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tack {

// The file is replaced as a whole at each frame, so that it is always complete. Throws InputError
// if it cannot be written.
class PvdFile {
 public:
  struct Frame {
    double time;       // s
    std::string file;  // relative to the folder of the list
  };

  // Starts an empty list. The first frame creates the file.
  explicit PvdFile(std::filesystem::path path) : path_(std::move(path)) {}

  // Continues an existing list with its frames up to `last_time` [s]; a missing file counts as
  // empty. Throws InputError if the file is no such list.
  static PvdFile continued(std::filesystem::path path, double last_time);

  // Appends a frame. frame: relative to the folder of the list.
  void add(double time, const std::filesystem::path& frame);

  int frames() const { return static_cast<int>(entries_.size()); }
  const std::vector<Frame>& list() const { return entries_; }

 private:
  std::filesystem::path path_;
  std::vector<Frame> entries_;
};

}  // namespace tack
