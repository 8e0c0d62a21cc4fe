// New results in the folder of a run, for its page: table rows, frames and the end.
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

  // Contents that a page has: rows of tables, number of frames, and whether it has the end.
  struct Known {
    int steps = 0, probes = 0, frames = 0;
    bool end = false;
  };
  // Returns {generation, steps and probes {columns, next, rows}, frames (frame_data of
  // run_data.hpp; with elements if the page has no frame), end {status, summary, laws}}, each only
  // if it is new. running: the run goes on.
  nlohmann::ordered_json since(const Known& known, bool running);
  // Reads the folder and returns its generation. It changes when another run replaces the run in
  // the folder, or the run is resumed from an earlier state.
  int generation();

 private:
  void update();
  void update_frame_list();
  nlohmann::ordered_json frames_since(int known);

  std::filesystem::path folder_;
  GrowingCsv steps_, probes_;
  int generation_ = 0;  // of both tables
  std::optional<FrameSeriesBuilder> follower_;
  std::vector<PvdFile::Frame> list_;
  std::filesystem::file_time_type list_time_{};  // time stamp of the list file
  std::uintmax_t list_bytes_ = 0;                // its size: two lists may have one time stamp
  double seconds_per_frame_ = 0.01;              // average time to read a frame
};

}  // namespace tack
