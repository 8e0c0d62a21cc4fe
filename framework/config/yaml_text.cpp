#include "framework/config/yaml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace tack {
namespace {

bool is_number(const std::string& text) {
  double number = 0;
  const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  return status == std::errc() && stop == text.data() + text.size();
}

// Returns true for texts that need no quotes in YAML, in block or flow style.
bool is_plain(const std::string& text) {
  if (text.empty()) return false;
  if (is_number(text)) return true;
  const unsigned char first = static_cast<unsigned char>(text.front());
  const auto harmless = [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '.' || c == '/' || c == '-' || c == '+' || c == '^';
  };
  const bool starts_well = std::isalpha(first) || first == '_' || first == '/';
  return starts_well && std::all_of(text.begin(), text.end(), harmless) && text != "null" &&
         text != "Null" && text != "NULL";
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const unsigned char u = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (u < 0x20 || u == 0x7f) {
      out += fmt::format("\\x{:02x}", u);
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string scalar_text(const std::string& text) { return is_plain(text) ? text : quoted(text); }

// Returns true for lists of scalars and lists of such lists (schedules), which are written in one
// line.
bool fits_one_line(const Value& v, int depth = 0) {
  if (v.is_map()) return v.entries.empty();
  if (depth > 2) return false;
  return std::all_of(v.items.begin(), v.items.end(),
                     [&](const Value& item) { return fits_one_line(item, depth + 1); });
}

void write_block(const Value& v, int indent, std::string& out);

// Writes a value after "key:" or "-": on the same line if it fits, else as an indented block.
void write_after(const Value& v, int indent, std::string& out) {
  if (!fits_one_line(v)) {
    out += '\n';
    return write_block(v, indent, out);
  }
  out += ' ' + inline_text(v);
  if (!v.comment.empty()) out += "  # " + v.comment;
  out += '\n';
}

void write_entries(const Value& map, int indent, bool indent_first, std::string& out) {
  for (const Value::Entry& e : map.entries) {
    if (indent_first) out.append(static_cast<std::size_t>(indent), ' ');
    indent_first = true;
    out += scalar_text(e.key) + ':';
    write_after(e.value, indent + 2, out);
  }
}

void write_block(const Value& v, int indent, std::string& out) {
  if (v.is_map()) return write_entries(v, indent, true, out);
  for (const Value& item : v.items) {
    out.append(static_cast<std::size_t>(indent), ' ');
    out += '-';
    if (item.is_map() && !item.entries.empty()) {  // the first key stands behind the dash
      out += ' ';
      write_entries(item, indent + 2, false, out);
    } else {
      write_after(item, indent + 2, out);
    }
  }
}

}  // namespace

std::string inline_text(const Value& v) {
  std::string out;
  switch (v.kind) {
    case Value::Kind::null:
      return "null";
    case Value::Kind::scalar:
      return scalar_text(v.text);
    case Value::Kind::sequence:
      for (const Value& item : v.items) out += (out.empty() ? "" : ", ") + inline_text(item);
      return "[" + out + "]";
    case Value::Kind::map:
      for (const Value::Entry& e : v.entries) {
        out += (out.empty() ? "" : ", ") + scalar_text(e.key) + ": " + inline_text(e.value);
      }
      return "{" + out + "}";
  }
  return out;
}

std::string yaml_text(const Value& v) {
  if (fits_one_line(v)) return inline_text(v) + "\n";
  std::string out;
  write_block(v, 0, out);
  return out;
}

}  // namespace tack
