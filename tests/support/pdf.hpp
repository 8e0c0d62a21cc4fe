// Contents of a PDF page, for tests of figures. Reads the single pages that cairo writes, with
// content that is compressed or not.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tack {

struct PdfPage {
  double width = 0, height = 0;     // pt
  std::vector<double> text_sizes;   // pt, of each piece of text that is shown
  std::vector<double> line_widths;  // pt, of each line that is drawn
  int images = 0;
  int fonts = 0, embedded_fonts = 0, type3_fonts = 0;
  // All text of the file, with one character for each that is shown in a single byte.
  std::string readable;
};

// Errors: std::runtime_error of a file that is no PDF, or one of several pages.
PdfPage read_pdf(const std::filesystem::path& path);

}  // namespace tack
