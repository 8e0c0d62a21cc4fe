#include "framework/report/page.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "framework/report/packing.hpp"
#include "geometry/errors.hpp"
#include "geometry/own_library.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view data_marker = "<!--data of the report-->";
constexpr std::string_view requests_none = "connect-src 'none'", requests_own = "connect-src 'self'";

// Escapes <, which JSON has in strings only.
std::string escape_for_script(const std::string& json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    if (c == '<') out += "\\u003c";
    else out += c;
  }
  return out;
}

}  // namespace

nlohmann::ordered_json PageData::add(const std::string& bytes) {
  std::string block = base64(deflated(bytes));
  if (placement_ == Blocks::inside) return block;
  blocks_.push_back(std::move(block));
  return static_cast<int>(blocks_.size()) - 1;
}

fs::path page_path() { return shared_file("report.html"); }

std::string page_with(const fs::path& path, const PageData& data, Requests requests) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  std::string page = text.str();
  const size_t rule = page.find(requests_none);
  if (requests == Requests::own && rule != page.npos) page.replace(rule, requests_none.size(), requests_own);
  const size_t at = page.find(data_marker);
  if (!in || at == page.npos || (requests == Requests::own && rule == page.npos))
    throw InputError(fmt::format("{}: the page of reports is not built; {}{}", path.string(), remedy_for_missing("tack_report", "./tack report"),
                                 is_installed() ? "" : " (needs npm: apt-get install nodejs npm)"));
  // Names and paths need not be UTF-8.
  constexpr auto lenient = nlohmann::ordered_json::error_handler_t::replace;
  std::string out = page.substr(0, at) + "<script type=\"application/json\" id=\"data\">" +
                    escape_for_script(data.document.dump(-1, ' ', false, lenient)) + "</script>\n";
  for (size_t i = 0; i < data.blocks().size(); ++i)
    out += fmt::format("<script type=\"text/plain\" id=\"block-{}\">{}</script>\n", i, data.blocks()[i]);
  return out + page.substr(at + data_marker.size());
}

}  // namespace tack
