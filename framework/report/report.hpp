// tack report: one HTML file for a run, several runs overlaid, a comparison, a leaderboard of a
// suite, a batch or a calibration.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/report/page.hpp"

namespace tack {

enum class FolderKind { run, comparison, suite, batch, calibration };
// Returns the kind of a folder by its files. Throws InputError for a missing folder or an unknown
// kind.
FolderKind kind_of(const std::filesystem::path& folder);

// Returns the shortest endings of the folders' paths that differ.
std::vector<std::string> labels_of(const std::vector<std::filesystem::path>& folders);

struct ReportSettings {
  std::vector<std::filesystem::path> folders;  // runs; or one of another kind
  // empty: report.html in the folder; for several folders, in the working directory
  std::filesystem::path output;
  int frames = 0;                  // limit; 0: 200, or fewer if a page would get too large
  std::vector<std::string> cases;  // cases of a batch whose runs are included
  std::string status;              // of runs without a summary; empty: "unfinished"
  std::filesystem::path page;      // empty: the page next to the program
  std::string version, commit;     // of the program
};

struct WrittenReport {
  std::filesystem::path path;
  std::vector<std::string> notes;  // reports of unreadable files
};

// Returns the data of the page. Throws InputError for folders that do not go together.
PageData report_data(const ReportSettings& settings);
// Returns the page's notes about unreadable files.
std::vector<std::string> notes_of(const PageData& page);

// Writes the report. Throws InputError for folders that do not go together and a file that cannot
// be written.
WrittenReport write_report(const ReportSettings& settings);

}  // namespace tack
