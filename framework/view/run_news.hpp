// What the folder of a run has that a page of it has not: rows of its tables, frames, and how it ended.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "framework/output/pvd.hpp"
#include "framework/report/frame_series.hpp"
#include "framework/view/growing_csv.hpp"

namespace tack {

class RunNews {
 public:
  explicit RunNews(std::filesystem::path folder);

  // How much a page has: rows of the tables, frames that it knows of, whether it knows the end.
  struct Known {
    int steps = 0, probes = 0, frames = 0;
    bool end = false;
  };
  // {generation, steps and probes {columns, next, rows}, frames (frame_data of run_data.hpp; with the elements if the page has no frame), end {status, summary, laws}}, each only
  // if there is news of it. `running`: whether the run goes on.
  nlohmann::ordered_json since(const Known& known, bool running);
  // Another one for each run that takes the place of the one before in the folder, or is gone on with from an earlier state. Looks anew.
  int generation();

 private:
  void look();
  void look_at_frames();
  nlohmann::ordered_json frames_since(int known);

  std::filesystem::path folder_;
  GrowingCsv steps_, probes_;
  int generation_ = 0;  // of both
  std::optional<FrameFollower> follower_;
  std::vector<PvdFile::Frame> list_;
  std::filesystem::file_time_type listed_{};  // when the list was written,
  std::uintmax_t list_bytes_ = 0;             // and how long it is: two may be written at what is the same time to the file system
  double seconds_per_frame_ = 0.01;           // that it takes to read one
};

}  // namespace tack
