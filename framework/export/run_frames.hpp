// The frames of a run: finds its results folder and reads its frames.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/output/pvd.hpp"
#include "geometry/io/frame_file.hpp"

namespace tack {

class RunFrames {
 public:
  // given: the results folder of a run, or its run.pvd. Throws InputError, with folders nearby that
  // have frames, if it has none.
  explicit RunFrames(const std::filesystem::path& given);

  const std::filesystem::path& folder() const { return folder_; }    // of the results
  const std::vector<PvdFile::Frame>& list() const { return list_; }  // at least one
  std::filesystem::path path_of(int number) const { return folder_ / list_[number].file; }

  // Reads a frame. Throws InputError, with its time and the remedy, if that is impossible.
  FrameFile read(int number) const;

  // Returns a sentence about a run that has not reached its end; "" if it has.
  std::string unfinished_note() const;

 private:
  std::filesystem::path folder_;
  std::vector<PvdFile::Frame> list_;
};

}  // namespace tack
