// Writes frames while the run goes on: compression and disk take no time of a step unless the next
// frame is due before the last is written. One frame is in flight at most, so that frames hold the
// memory of one. run.pvd lists a frame once its file is complete.
//
// A frame that could not be written is reported by the next write() or flush(), with the errors of
// write_vtu() and PvdFile::add(). A run calls flush() before a checkpoint, so that a resumed run
// finds all frames up to there, and at its end.
#pragma once

#include <future>
#include <vector>

#include "framework/output/pvd.hpp"
#include "framework/output/run_folder.hpp"
#include "framework/output/vtu.hpp"

namespace tack {

class FrameWriter {
 public:
  // list: the frames so far.
  FrameWriter(RunFolder folder, PvdFile list, FrameGeometry geometry);
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  const FrameGeometry& geometry() const { return geometry_; }

  // Waits for the frame before and starts to write this one. x: as for write_vtu().
  void write(double time, VecX x, std::vector<PointField> fields,
             std::vector<CellField> cell_fields);
  // Returns once all frames are written.
  void flush();

 private:
  struct Frame {
    double time = 0;  // s
    VecX x;
    std::vector<PointField> fields;
    std::vector<CellField> cell_fields;
  };
  void write_frame();

  RunFolder folder_;
  PvdFile list_;
  FrameGeometry geometry_;
  Frame frame_;  // the one in flight
  // The last member: its destructor waits for the thread, which reads the others.
  std::future<void> in_flight_;
};

}  // namespace tack
