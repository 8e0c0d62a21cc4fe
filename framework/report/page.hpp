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
  // Where blocks go: beside the document, which has their numbers, or into it.
  enum class Blocks { beside, inside };
  explicit PageData(Blocks where = Blocks::beside) : where_(where) {}

  // Keys: kind (run, runs, comparison, batch, calibration, preview), title, made, runs [run_data.hpp], comparison, batch, calibration [table_data.hpp],
  // preview (view/preview.hpp), live (view/run_view.hpp).
  nlohmann::ordered_json document;

  // Of a block of bytes, deflated, what stands for it in the document.
  nlohmann::ordered_json add(const std::string& bytes);
  const std::vector<std::string>& blocks() const { return blocks_; }

 private:
  Blocks where_;
  std::vector<std::string> blocks_;  // in base64
};

// Where it is beside the program: share/report.html of its build folder, share/tack/report.html where tack is installed.
std::filesystem::path page_path();

// What the page may ask for over the network: nothing, or what is served beside it.
enum class Requests { none, own };

// The page with data; nothing in a text of theirs ends or begins a tag. Throws InputError with the remedy if the page is not
// there or none of ours.
std::string page_with(const std::filesystem::path& page, const PageData& data, Requests requests = Requests::none);

}  // namespace tack
