// tack report: one HTML file for a run, several runs over each other, a comparison, a batch or a calibration.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/report/page.hpp"

namespace tack {

enum class FolderKind { run, comparison, batch, calibration };
// By the files that it holds. Throws InputError for a folder that is not there, or none of these.
FolderKind kind_of(const std::filesystem::path& folder);

struct ReportSettings {
  std::vector<std::filesystem::path> folders;  // runs; or one comparison, batch or calibration
  std::filesystem::path output;                // empty: report.html in the folder; of several, in the working directory
  int frames = 0;                              // at most so many; 0: 200, or as many as a page should carry
  std::vector<std::string> cases;              // of a batch: whose runs are shown as well
  std::filesystem::path page;                  // empty: that beside the program
  std::string version, commit;                 // of the program
};

struct WrittenReport {
  std::filesystem::path path;
  std::vector<std::string> notes;  // what could not be read
};

// What the page of them holds. Throws InputError for folders that do not go together.
PageData report_data(const ReportSettings& settings);
// Texts of it about what could not be read.
std::vector<std::string> notes_of(const PageData& page);

// Throws InputError for folders that do not go together and a file that cannot be written.
WrittenReport write_report(const ReportSettings& settings);

}  // namespace tack
