#include "framework/export/run_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "framework/output/recorded_status.hpp"
#include "framework/output/summary.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

// Returns the results folder that `given` names. Throws InputError unless it has frames.
fs::path folder_with_frames(const fs::path& given) {
  std::error_code none;
  if (given.filename() == "run.pvd" && fs::exists(given, none)) return given.has_parent_path() ? given.parent_path() : fs::path(".");
  if (fs::exists(given / "run.pvd", none)) return given;
  if (!fs::exists(given, none)) throw InputError(fmt::format("{}: there is no such folder; give the results folder of a run", given.string()));
  if (!fs::is_directory(given, none)) throw InputError(fmt::format("{}: is a file; give the results folder of a run", given.string()));
  std::vector<std::string> runs;
  for (const auto& entry : fs::directory_iterator(given, none))
    if (fs::exists(entry.path() / "run.pvd", none)) runs.push_back(entry.path().string());
  if (fs::exists(given.parent_path() / "run.pvd", none)) runs.push_back(given.parent_path().string());
  std::sort(runs.begin(), runs.end());
  constexpr size_t shown_max = 8;
  const bool more = runs.size() > shown_max;
  if (more) runs.resize(shown_max);
  if (!runs.empty())
    throw InputError(fmt::format("{}: is no results folder; these are: {}{}", given.string(), fmt::join(runs, ", "), more ? ", ..." : ""));
  throw InputError(fmt::format("{}: has no frames (run.pvd); give the results folder of a run that writes them (output.frames)", given.string()));
}

}  // namespace

RunFrames::RunFrames(const fs::path& given) : folder_(folder_with_frames(given)) {
  list_ = PvdFile::continued(folder_ / "run.pvd", std::numeric_limits<double>::infinity()).list();
  if (list_.empty()) throw InputError(fmt::format("{}: lists no frame yet; wait for the first", (folder_ / "run.pvd").string()));
}

FrameFile RunFrames::read(int number) const {
  const fs::path path = path_of(number);
  const auto failed = [&](const std::string& why) {
    return InputError(fmt::format("{}: the frame at {:.6g} s {}; {}run the scene again", path.string(), list_[number].time, why,
                                  number == 0 ? "the elements are read from it: " : "leave it out by from=... or to=..., or "));
  };
  std::error_code none;
  if (!fs::exists(path, none)) throw failed("is missing");
  try {
    return read_frame(path);
  } catch (const InputError&) {
    throw failed("cannot be read, as if it was cut short");
  }
}

std::string RunFrames::unfinished_note() const {
  const double last = list_.back().time;
  const std::string status = recorded_status(folder_);
  if (status == unfinished_status) return fmt::format("the run has not ended; its frames reach to {:.6g} s", last);
  if (status == to_string(RunStatus::done) || status == to_string(RunStatus::expectation_failed)) return "";
  return fmt::format("the run ended early ({}); its frames reach to {:.6g} s", status, last);
}

}  // namespace tack
