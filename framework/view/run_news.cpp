#include "framework/view/run_news.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "framework/config/read_file.hpp"
#include "framework/output/recorded_status.hpp"
#include "framework/report/run_data.hpp"
#include "framework/report/table_data.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int row_count_max = 2000, frame_count_max = 60;
constexpr double answer_seconds_max = 0.3;  // limit for the frames of one answer [s]

Json rows_since(const GrowingCsv& table, int known) {
  if (table.columns().empty() || known >= table.rows()) return Json();
  return {{"columns", table.columns()}, {"next", table.rows()}, {"rows", table.rows(known, row_count_max)}};
}

// Returns null if the file is missing or incomplete.
template <class Read>
Json json_or_null(const fs::path& path, const Read& read) {
  if (!fs::exists(path)) return Json();
  try {
    return read(path);
  } catch (const InputError&) {
  } catch (const Json::exception&) {
  }
  return Json();
}

}  // namespace

RunNews::RunNews(fs::path folder) : folder_(std::move(folder)), steps_(folder_ / "steps.csv"), probes_(folder_ / "probes.csv") {}

int RunNews::generation() {
  update();
  return generation_;
}

void RunNews::update() {
  steps_.update();
  probes_.update();
  update_frame_list();
  if (generation_ == steps_.generation() + probes_.generation()) return;
  generation_ = steps_.generation() + probes_.generation();
  follower_.reset();
}

void RunNews::update_frame_list() {
  std::error_code none;
  const auto written = fs::last_write_time(folder_ / "run.pvd", none);
  const std::uintmax_t bytes = none ? 0 : fs::file_size(folder_ / "run.pvd", none);
  if (none) return list_.clear();
  if (written == list_time_ && bytes == list_bytes_) return;
  try {
    list_ = PvdFile::continued(folder_ / "run.pvd", std::numeric_limits<double>::infinity()).list();
    list_time_ = written;
    list_bytes_ = bytes;
  } catch (const InputError&) {
    list_.clear();
  }
}

Json RunNews::since(const Known& known, bool running) {
  update();
  Json news = {{"generation", generation_}};
  if (Json rows = rows_since(steps_, known.steps); !rows.is_null()) news["steps"] = std::move(rows);
  if (Json rows = rows_since(probes_, known.probes); !rows.is_null()) news["probes"] = std::move(rows);
  if (Json frames = frames_since(known.frames); !frames.is_null()) news["frames"] = std::move(frames);
  if (running || known.end) return news;
  Json summary = json_or_null(folder_ / "summary.json", [](const fs::path& path) { return Json::parse(read_file(path, largest_text)); });
  std::string status = recorded_status(summary);
  news["end"] = {{"status", std::move(status)}, {"summary", std::move(summary)},
                 {"laws", json_or_null(folder_ / "laws.csv", [](const fs::path& path) { return text_table(read_csv_texts(path)); })}};
  return news;
}

// Reads as many frames as the time limit allows, including the newest; skips unreadable ones.
Json RunNews::frames_since(int known) {
  const int count = static_cast<int>(list_.size());
  if (known >= count) return Json();
  try {
    if (!follower_) follower_.emplace(read_frame(folder_ / list_[0].file));
  } catch (const InputError&) {
    return Json();
  }
  FrameSeries& series = follower_->series();
  const auto begun = std::chrono::steady_clock::now();
  const std::vector<int> chosen = spaced_indices(count - known, std::clamp(static_cast<int>(answer_seconds_max / seconds_per_frame_), 1, frame_count_max));
  for (const int i : chosen) {
    const PvdFile::Frame& frame = list_[static_cast<size_t>(known + i)];
    try {
      follower_->add(frame.time, read_frame(folder_ / frame.file));
    } catch (const InputError&) {
    }
  }
  seconds_per_frame_ = std::max(1e-4, std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() / static_cast<double>(chosen.size()));
  if (series.times.empty()) return Json();
  series.written = count;
  PageData page(PageData::Blocks::inside);
  Json data = frame_data(series, page, known == 0);
  series.times.clear();
  series.positions.clear();
  for (auto& field : series.fields) field.frames.clear();
  return data;
}

}  // namespace tack
