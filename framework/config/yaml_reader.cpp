#include "framework/config/yaml_reader.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <charconv>
#include <map>
#include <sstream>

#include "geometry/errors.hpp"

namespace tack {
namespace {

// Limit of nodes: aliases of aliases grow exponentially, and no scene comes near this number.
constexpr std::size_t nodes_max = 1'000'000;

// Builds the tree from the parser's events. open_: collections not yet ended.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(std::shared_ptr<const std::string> file) : file_(std::move(file)) {}

  Value take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    add_value(make(Value::Kind::null, mark), anchor);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    Value v = make(Value::Kind::scalar, mark);
    refuse_tag(tag, v.mark);
    v.text = text;
    add_value(std::move(v), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) fail(at(mark), "an alias may not refer to what encloses it");
    count_nodes(count_values(found->second), at(mark));
    add_value(found->second, 0);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(Value::Kind::sequence, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(Value::Kind::map, mark, tag, anchor);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    Value value;
    YAML::anchor_t anchor;
    bool has_key = false;
    std::string key;
    SourceMark key_mark;
  };

  SourceMark at(const YAML::Mark& mark) const { return {file_, mark.line + 1, mark.column + 1}; }

  [[noreturn]] static void fail(const SourceMark& mark, std::string_view message) {
    throw InputError(fmt::format("{}: {}", mark.text(), message));
  }

  static void refuse_tag(const std::string& tag, const SourceMark& mark) {
    const bool plain = tag.empty() || tag == "?" || tag == "!";
    if (!plain) fail(mark, fmt::format("the YAML tag '{}' is not supported; remove it", tag));
  }

  void count_nodes(std::size_t nodes, const SourceMark& mark) {
    nodes_ += nodes;
    if (nodes_ > nodes_max) fail(mark, fmt::format("more than {} values", nodes_max));
  }

  Value make(Value::Kind kind, const YAML::Mark& mark) {
    Value v;
    v.kind = kind;
    v.mark = at(mark);
    count_nodes(1, v.mark);
    return v;
  }

  void open(Value::Kind kind, const YAML::Mark& mark, const std::string& tag,
            YAML::anchor_t anchor) {
    Open o{make(kind, mark), anchor, false, {}, {}};
    refuse_tag(tag, o.value.mark);
    open_.push_back(std::move(o));
  }

  void close() {
    Open done = std::move(open_.back());
    open_.pop_back();
    add_value(std::move(done.value), done.anchor);
  }

  void add_value(Value v, YAML::anchor_t anchor) {
    if (anchor != 0) anchors_[anchor] = v;
    if (open_.empty()) {
      root_ = std::move(v);
    } else if (open_.back().value.is_sequence()) {
      open_.back().value.items.push_back(std::move(v));
    } else if (open_.back().has_key) {
      add_entry(open_.back(), std::move(v));
    } else {
      set_key(open_.back(), std::move(v));
    }
  }

  static void set_key(Open& map, Value v) {
    if (!v.is_scalar()) fail(v.mark, "a key must be a text");
    if (map.value.find(v.text)) {
      fail(v.mark, fmt::format("duplicate key '{}'; keep one of them", v.text));
    }
    map.key = std::move(v.text);
    map.key_mark = std::move(v.mark);
    map.has_key = true;
  }

  static void add_entry(Open& map, Value v) {
    // The parser notices an empty value only at the next token, often on the next line.
    if (v.is_null()) v.mark = map.key_mark;
    map.value.entries.push_back({std::move(map.key), std::move(map.key_mark), std::move(v)});
    map.has_key = false;
  }

  std::shared_ptr<const std::string> file_;
  std::map<YAML::anchor_t, Value> anchors_;
  std::vector<Open> open_;
  Value root_;
  std::size_t nodes_ = 0;
};

// Returns the code of a "\uXXXX" escape at a position; -1 if there is none.
int escaped_unit(const std::string& text, size_t at) {
  int unit = 0;
  if (at + 6 > text.size() || text[at] != '\\' || text[at + 1] != 'u') return -1;
  const auto [stop, status] = std::from_chars(text.data() + at + 2, text.data() + at + 6, unit, 16);
  return status == std::errc() && stop == text.data() + at + 6 ? unit : -1;
}

// Joins surrogate pairs: JSON writes a character beyond U+FFFF as two escapes, "\ud83d\ude00", YAML
// as one, "\U0001f600".
std::string with_joined_surrogates(const std::string& text) {
  std::string joined;
  for (size_t i = 0; i < text.size(); ++i) {
    const int high = escaped_unit(text, i), low = high >= 0xd800 && high < 0xdc00 ? escaped_unit(text, i + 6) : -1;
    if (low >= 0xdc00 && low < 0xe000) {
      joined += fmt::format("\\U{:08x}", 0x10000 + ((high - 0xd800) << 10) + (low - 0xdc00));
      i += 11;
      continue;
    }
    joined += text[i];
    if (text[i] == '\\' && i + 1 < text.size()) joined += text[++i];  // an escaped backslash begins no escape
  }
  return joined;
}

// Returns line `number` (from 1) without its line break; empty if there is none.
std::string_view line_of(std::string_view text, int number) {
  for (int i = 1; i < number; ++i) {
    const size_t end = text.find('\n');
    if (end == text.npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

// Returns the key of a line "  - key:value" without a space after the colon; empty if it has none.
std::string_view key_without_space(std::string_view line) {
  const size_t begin = line.find_first_not_of(" -"), colon = line.find(':');
  if (begin == line.npos || colon == line.npos || colon < begin || colon + 1 == line.size()) return {};
  const std::string_view key = line.substr(begin, colon - begin);
  const bool plain = !key.empty() && key.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == key.npos;
  return plain && line[colon + 1] != ' ' && line[colon + 1] != '\r' && !line.substr(colon + 1).starts_with("//") ? key : std::string_view{};
}

// Returns the message of a syntax error. The parser notices some mistakes a line late.
std::string syntax_error(const std::string& text, const SourceMark& mark, const std::string& message) {
  for (int number = mark.line; number > 0 && number > mark.line - 3; --number) {
    const std::string_view line = line_of(text, number), key = key_without_space(line);
    if (key.empty()) continue;
    const SourceMark there{mark.file, number, static_cast<int>(key.data() + key.size() - line.data()) + 1};
    return fmt::format("{}: not valid YAML: a space is missing after the colon of '{}:'", there.text(), key);
  }
  const std::string_view line = line_of(text, mark.line);
  const bool tab = line.substr(0, std::min(line.find_first_not_of(" \t"), line.size())).find('\t') != line.npos;
  return fmt::format("{}: not valid YAML: {}{}", mark.text(), message, tab ? "; this line is indented by a tab; use spaces" : "");
}

}  // namespace

std::size_t count_values(const Value& v) {
  std::size_t n = 1;
  for (const Value& item : v.items) n += count_values(item);
  for (const auto& e : v.entries) n += count_values(e.value);
  return n;
}

Value read_yaml(const std::string& text, const std::string& name) {
  const auto file = std::make_shared<const std::string>(name);
  try {
    std::istringstream stream(text.find("\\ud") == text.npos && text.find("\\uD") == text.npos ? text : with_joined_surrogates(text));
    YAML::Parser parser(stream);
    TreeBuilder builder(file);
    if (!parser.HandleNextDocument(builder)) {
      Value empty;
      empty.mark = {file, 1, 1};
      return empty;
    }
    TreeBuilder rest(file);
    if (parser.HandleNextDocument(rest)) {
      throw InputError(fmt::format("{}: holds several documents ('---'); keep one", name));
    }
    return builder.take();
  } catch (const YAML::Exception& e) {
    const SourceMark mark{file, e.mark.line + 1, e.mark.column + 1};
    throw InputError(syntax_error(text, mark, e.msg));
  }
}

}  // namespace tack
