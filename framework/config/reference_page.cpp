// The Markdown reference on one page: one table per struct and component.
#include <fmt/format.h>

#include "framework/config/describe.hpp"
#include "framework/config/reference_text.hpp"
#include "framework/config/words.hpp"

namespace tack {
namespace {

void write_kind(const Kind& kind, std::string& out) {
  out += fmt::format("\n## {}\n\n{}\n", kind.name(), kind.doc());
  for (const auto& [name, entry] : kind.entries())
    out += fmt::format("\n### {} `{}`\n\n{}", kind.name(), name, component_text(kind, entry, KindLinks::anchors));
}

}  // namespace

std::string reference_page(const Fields& root, const std::string& title) {
  std::string out = fmt::format("# {}\n\n{}\n{}", title, reference_conventions, parameter_table(root));
  for (const Kind* kind : registered_kinds()) write_kind(*kind, out);
  return out;
}

}  // namespace tack
