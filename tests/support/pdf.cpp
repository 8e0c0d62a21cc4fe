#include "tests/support/pdf.hpp"

#include <zlib.h>

#include <cmath>
#include <map>
#include <regex>
#include <stdexcept>

#include "tests/support/program.hpp"

namespace tack {
namespace {

// "" unless it is compressed so.
std::string inflated(const std::string& packed) {
  std::string out;
  z_stream z{};
  if (inflateInit(&z) != Z_OK) return out;
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  z.avail_in = static_cast<uInt>(packed.size());
  char part[1 << 14];
  int code = Z_OK;
  while (code == Z_OK) {
    z.next_out = reinterpret_cast<Bytef*>(part);
    z.avail_out = sizeof part;
    code = inflate(&z, Z_NO_FLUSH);
    out.append(part, sizeof part - z.avail_out);
  }
  inflateEnd(&z);
  return code == Z_STREAM_END ? out : "";
}

struct Matrix {
  double a = 1, b = 0, c = 0, d = 1;
  double scale() const { return std::sqrt(std::abs(a * d - b * c)); }
  Matrix times(const Matrix& m) const { return {a * m.a + b * m.c, a * m.b + b * m.d, c * m.a + d * m.c, c * m.b + d * m.d}; }
};

// The operators of a page's content (PDF 32000-1:2008, annex A) that say how large text and lines are.
class Content {
 public:
  explicit Content(PdfPage& page) : page_(page) {}

  void read(const std::string& text) {
    for (size_t at = 0; at < text.size();) {
      const char c = text[at];
      if (c == '(') {
        at = string(text, at);
      } else if (std::isspace(static_cast<unsigned char>(c)) || c == '[' || c == ']') {
        ++at;
      } else if (c == '<' && text.compare(at, 2, "<<") != 0) {
        at = text.find('>', at) + 1;
      } else {
        const size_t end = std::min(text.find_first_of(" \r\n\t[]()<", at + (c == '<' ? 2 : 1)), text.size());
        word(text.substr(at, end - at));
        at = end;
      }
    }
  }

 private:
  size_t string(const std::string& text, size_t at) {
    int open = 0;
    for (; at < text.size(); ++at) {
      if (text[at] == '\\') {
        ++at;
      } else if (text[at] == '(') {
        ++open;
      } else if (text[at] == ')') {
        if (--open == 0) return at + 1;
      } else {
        page_.readable += text[at];
      }
    }
    return at;
  }

  void word(const std::string& w) {
    char* end = nullptr;
    if (const double number = std::strtod(w.c_str(), &end); *end == '\0') {
      numbers_.push_back(number);
      return;
    }
    if (w[0] == '/') return;
    const auto matrix = [&] {
      if (numbers_.size() < 6) throw std::runtime_error("PDF: a matrix of less than six numbers");
      const double* n = &numbers_[numbers_.size() - 6];
      return Matrix{n[0], n[1], n[2], n[3]};
    };
    if (w == "q") saved_.push_back({to_page_, line_width_});
    if (w == "Q" && !saved_.empty()) std::tie(to_page_, line_width_) = saved_.back(), saved_.pop_back();
    if (w == "cm") to_page_ = matrix().times(to_page_);
    if (w == "w") line_width_ = numbers_.at(0);
    if (w == "BT") text_ = {}, page_.readable += '\n';
    if (w == "Tm") text_ = matrix(), page_.readable += '\n';
    if (w == "Tf") font_size_ = numbers_.at(0);
    if (w == "Tj" || w == "TJ") page_.text_sizes.push_back(font_size_ * text_.times(to_page_).scale());
    if (w == "S" || w == "s" || w == "B" || w == "b" || w == "B*" || w == "b*") page_.line_widths.push_back(line_width_ * to_page_.scale());
    numbers_.clear();
  }

  PdfPage& page_;
  std::vector<double> numbers_;
  std::vector<std::pair<Matrix, double>> saved_;
  Matrix to_page_, text_;
  double line_width_ = 1, font_size_ = 0;
};

int count(const std::string& text, const std::string& pattern) {
  const std::regex all(pattern);
  return static_cast<int>(std::distance(std::sregex_iterator(text.begin(), text.end(), all), std::sregex_iterator()));
}

}  // namespace

PdfPage read_pdf(const std::filesystem::path& path) {
  const std::string file = file_text(path);
  if (!file.starts_with("%PDF")) throw std::runtime_error(path.string() + " is no PDF");
  std::string objects, contents;
  size_t done = 0;
  for (size_t at = file.find("stream\n"); at != file.npos; at = file.find("\nstream\n", done)) {
    const size_t data = file.find('\n', at + 1) + 1, end = file.find("endstream", data);
    const std::string dictionary = file.substr(file.rfind("obj", at), at - file.rfind("obj", at)), text = inflated(file.substr(data, end - data));
    objects += file.substr(done, data - done);
    if (contains(dictionary, "/ObjStm")) objects += text;
    if (!contains(dictionary, "/Length1") && !contains(dictionary, "/Subtype") && !contains(dictionary, "/Type") && !contains(text, "begincmap")) contents += text + "\n";
    done = end + 9;
  }
  objects += file.substr(done);
  PdfPage page;
  std::smatch box;
  if (count(objects, R"(/Type\s*/Page\b)") != 1 || !std::regex_search(objects, box, std::regex(R"(/MediaBox\s*\[\s*0\s+0\s+([\d.]+)\s+([\d.]+))")))
    throw std::runtime_error(path.string() + " has not one page");
  page.width = std::stod(box[1]);
  page.height = std::stod(box[2]);
  page.images = count(objects, R"(/Subtype\s*/Image\b)");
  page.fonts = count(objects, R"(/Type\s*/FontDescriptor\b)");
  page.embedded_fonts = count(objects, R"(/FontFile[23]?\b)");
  page.type3_fonts = count(objects, R"(/Subtype\s*/Type3\b)");
  Content(page).read(contents);
  return page;
}

}  // namespace tack
