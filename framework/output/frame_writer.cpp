#include "framework/output/frame_writer.hpp"

#include <system_error>
#include <utility>

namespace tack {

FrameWriter::FrameWriter(RunFolder folder, PvdFile list, FrameGeometry geometry)
    : folder_(std::move(folder)), list_(std::move(list)), geometry_(std::move(geometry)) {}

void FrameWriter::write(double time, VecX x, std::vector<PointField> fields, std::vector<CellField> cell_fields) {
  flush();
  frame_ = {time, std::move(x), std::move(fields), std::move(cell_fields)};
  try {
    in_flight_ = std::async(std::launch::async, &FrameWriter::write_frame, this);
  } catch (const std::system_error&) {  // no thread to be had
    write_frame();
  }
}

void FrameWriter::flush() {
  if (in_flight_.valid()) in_flight_.get();
}

void FrameWriter::write_frame() {
  const Frame frame = std::move(frame_);
  const auto file = RunFolder::frame(list_.frames());
  std::error_code failed;  // writing reports the error
  std::filesystem::create_directory(folder_.frames(), failed);
  write_vtu(folder_.root() / file, geometry_, frame.x, frame.time, frame.fields, frame.cell_fields);
  list_.add(frame.time, file);
}

}  // namespace tack
