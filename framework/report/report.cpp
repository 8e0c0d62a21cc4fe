#include "framework/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/report/run_data.hpp"
#include "framework/report/table_data.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path canonical_path(const fs::path& folder) {
  const fs::path path = fs::weakly_canonical(fs::absolute(folder));
  return path.has_filename() ? path : path.parent_path();
}

fs::path case_folder(const Json& batch, const fs::path& folder, const std::string& name) {
  for (const Json& one : batch["batch"]["cases"])
    if (one.value("name", "") == name) return folder / one.value("folder", "");
  throw InputError(fmt::format("{}: has no case '{}'; its cases are in results.csv", folder.string(), name));
}

fs::path output_of(const ReportSettings& s) {
  if (!s.output.empty()) return s.output;
  return s.folders.size() == 1 ? s.folders[0] / "report.html" : fs::path("report.html");
}

}  // namespace

std::vector<std::string> labels_of(const std::vector<fs::path>& folders) {
  std::vector<std::string> labels(folders.size());
  std::vector<fs::path> rest;
  for (const fs::path& folder : folders) rest.push_back(canonical_path(folder));
  for (bool unique = false; !unique;) {
    bool grown = false;
    for (size_t i = 0; i < labels.size(); ++i) {
      if (!rest[i].has_filename()) continue;
      labels[i] = rest[i].filename().string() + (labels[i].empty() ? "" : "/" + labels[i]);
      rest[i] = rest[i].parent_path();
      grown = true;
    }
    std::vector<std::string> sorted = labels;
    std::sort(sorted.begin(), sorted.end());
    unique = !grown || std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
  }
  return labels;
}

FolderKind kind_of(const fs::path& folder) {
  if (!fs::exists(folder)) throw InputError(fmt::format("{}: there is no such folder", folder.string()));
  if (fs::exists(folder / "calibration.json")) return FolderKind::calibration;
  if (fs::exists(folder / "batch.json")) return FolderKind::batch;
  if (fs::exists(folder / "leaderboard.json")) return FolderKind::suite;
  if (fs::exists(folder / "compare.csv")) return FolderKind::comparison;
  for (const char* file : {"scene.yaml", "summary.json", "steps.csv", "run.pvd"})
    if (fs::exists(folder / file)) return FolderKind::run;
  throw InputError(fmt::format("{}: is not a results folder; give one of "
                               "`tack run`, `tack suite`, `tack compare`, `tack batch` or `tack calibrate`", folder.string()));
}

PageData report_data(const ReportSettings& s) {
  std::vector<FolderKind> kinds;
  for (const fs::path& folder : s.folders) kinds.push_back(kind_of(folder));
  const bool runs = std::all_of(kinds.begin(), kinds.end(), [](FolderKind kind) { return kind == FolderKind::run; });
  if (kinds.empty() || (!runs && kinds.size() > 1))
    throw InputError("a report is of one or more runs, or of one comparison, suite, batch or calibration");
  if (!s.cases.empty() && kinds[0] != FolderKind::batch) throw InputError("--case is for a batch");

  PageData page;
  const std::vector<std::string> labels = labels_of(s.folders);
  std::vector<std::pair<fs::path, std::string>> shown;
  Json& document = page.document;
  document = {{"format", 1}, {"kind", ""}, {"title", labels[0]}, {"made", {{"version", s.version}, {"commit", s.commit}}}};
  if (runs) {
    document["kind"] = s.folders.size() > 1 ? "runs" : "run";
    for (size_t i = 0; i < labels.size(); ++i) shown.emplace_back(s.folders[i], labels[i]);
  } else if (kinds[0] == FolderKind::comparison) {
    document["kind"] = "comparison";
    document["comparison"] = comparison_data(s.folders[0]);
  } else if (kinds[0] == FolderKind::suite) {
    document["kind"] = "suite";
    document["suite"] = suite_data(s.folders[0]);
  } else if (kinds[0] == FolderKind::calibration) {
    document["kind"] = "calibration";
    document["calibration"] = calibration_data(s.folders[0], page);
  } else {
    document["kind"] = "batch";
    document["batch"] = batch_data(s.folders[0], page);
    for (const std::string& name : s.cases) shown.emplace_back(case_folder(document["batch"], s.folders[0], name), name);
  }
  document["runs"] = Json::array();
  for (const auto& [folder, label] : shown) {
    Json run = run_data(folder, label, s.frames, page);
    if (!s.status.empty() && run["summary"].is_null()) run["status"] = s.status;
    document["runs"].push_back(std::move(run));
  }
  return page;
}

std::vector<std::string> notes_of(const PageData& page) {
  std::vector<std::string> notes;
  const auto take = [&](const Json& of) {
    for (const Json& note : of["notes"]) notes.push_back(note.get<std::string>());
  };
  for (const Json& run : page.document["runs"]) take(run);
  for (const char* kind : {"batch", "calibration"})
    if (page.document.contains(kind)) take(page.document[kind]);
  return notes;
}

WrittenReport write_report(const ReportSettings& s) {
  const PageData page = report_data(s);
  WrittenReport written{output_of(s), notes_of(page)};
  replace_file(written.path, page_with(s.page.empty() ? page_path() : s.page, page));
  return written;
}

}  // namespace tack
