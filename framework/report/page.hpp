// A report as one HTML file: the page of report/ with data inserted.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tack {

// Data of a page: a JSON document and blocks of numbers, which it refers to by index (packing.hpp).
class PageData {
 public:
  // beside: blocks are stored outside the document, which has their indices; inside: in it.
  enum class Blocks { beside, inside };
  explicit PageData(Blocks where = Blocks::beside) : placement_(where) {}

  // The document's keys:
  //    kind          run, runs, comparison, suite, batch, calibration or preview
  //    title, made
  //    runs          run_data.hpp
  //    comparison, suite, batch, calibration   table_data.hpp
  //    preview       view/preview.hpp
  //    live          view/run_view.hpp
  nlohmann::ordered_json document;

  // Deflates and adds a block of bytes. Returns its reference in the document.
  nlohmann::ordered_json add(const std::string& bytes);
  const std::vector<std::string>& blocks() const { return blocks_; }

 private:
  Blocks placement_;
  std::vector<std::string> blocks_;  // in base64
};

// Returns the path of the page: share/report.html of the program's build folder, or
// share/tack/report.html of an installation.
std::filesystem::path page_path();

// Network requests that the page may make: none, or to its own server.
enum class Requests { none, own };

// Returns the page with data, escaped so that no text can begin or end a tag. Throws InputError
// with the remedy if the page is missing or not ours.
std::string page_with(const std::filesystem::path& page, const PageData& data,
                      Requests requests = Requests::none);

}  // namespace tack
