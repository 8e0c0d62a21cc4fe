// A report as one file: the page of report/ with data laid into it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tack {

// What the page shows: a JSON document, and numbers that it refers to by their place in the list (packing.hpp).
class PageData {
 public:
  // Keys: kind (run, runs, comparison, batch, calibration), title, made, runs [run_data.hpp], comparison, batch, calibration [table_data.hpp].
  nlohmann::ordered_json document;

  // The number of a block of bytes, deflated.
  int add(const std::string& bytes);
  const std::vector<std::string>& blocks() const { return blocks_; }

 private:
  std::vector<std::string> blocks_;  // in base64
};

// Where it is beside the program: share/report.html of its build folder, share/tack/report.html where tack is installed.
std::filesystem::path page_path();

// The page with data; nothing in a text of theirs ends or begins a tag. Throws InputError with the remedy if the page is not
// there or none of ours.
std::string page_with(const std::filesystem::path& page, const PageData& data);

}  // namespace tack
