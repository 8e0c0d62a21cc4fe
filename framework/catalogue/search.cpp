#include "framework/catalogue/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>

#include "framework/catalogue/trade_words.hpp"
#include "framework/config/describe.hpp"
#include "framework/config/nearest.hpp"
#include "framework/output/frame_fields.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr size_t shown_max = 12;          // rows per section
constexpr size_t shown_components_max = 3;  // of a key

using Words = std::vector<std::string>;

// Returns the words of a text in lower case, without a plural s.
Words words_of(std::string_view text) {
  Words words(1);
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) || static_cast<unsigned char>(c) > 127) words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!words.back().empty()) words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  for (std::string& word : words)
    if (word.size() > 3 && word.ends_with('s')) word.pop_back();
  return words;
}

// Returns true if each word begins a word of the text.
bool begin_words_of(const Words& words, const Words& text) {
  return std::all_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::any_of(text.begin(), text.end(), [&](const std::string& other) { return other.starts_with(word); });
  });
}

// Rank of a match: 0 the name itself, 1 words of the name, 2 words of the description.
std::optional<int> rank_of(const Words& query, std::string_view name, std::string_view about) {
  const Words named = words_of(name);
  if (named == query) return 0;
  if (begin_words_of(query, named)) return 1;
  Words all = words_of(about);
  all.insert(all.end(), named.begin(), named.end());
  if (begin_words_of(query, all)) return 2;
  return std::nullopt;
}

std::vector<std::string_view> items_of(std::string_view list) {
  std::vector<std::string_view> items;
  while (!list.empty()) {
    const size_t end = std::min(list.find(", "), list.size());
    items.push_back(list.substr(0, end));
    list.remove_prefix(std::min(list.size(), end + 2));
  }
  return items;
}

class Section {
 public:
  explicit Section(std::string title) : title_(std::move(title)) {}

  void add(int rank, std::string name, std::string about) { rows_.push_back({rank, std::move(name), std::move(about)}); }
  void offer(const Words& query, const std::string& name, const std::string& about) {
    if (const auto rank = rank_of(query, name, about)) add(*rank, name, about);
  }

  std::string text() {
    if (rows_.empty()) return "";
    std::stable_sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.rank < b.rank; });
    const size_t shown = std::min(rows_.size(), shown_max);
    size_t width = 0;
    for (size_t i = 0; i < shown; ++i) width = std::max(width, rows_[i].name.size());
    std::string out = title_ + ":\n";
    for (size_t i = 0; i < shown; ++i) out += rows_[i].about.empty() ? fmt::format("  {}\n", rows_[i].name) : fmt::format("  {:<{}}  {}\n", rows_[i].name, width, rows_[i].about);
    if (rows_.size() > shown) out += fmt::format("  and {} more; add a word to narrow the search\n", rows_.size() - shown);
    return out;
  }

 private:
  struct Row {
    int rank;
    std::string name, about;
  };
  std::string title_;
  std::vector<Row> rows_;
};

// Rank of the best term of an entry: the query itself, its words, or a term that the query contains.
std::optional<int> rank_of(const Words& query, const TradeWord& entry) {
  std::optional<int> best;
  for (const std::string_view term : items_of(entry.words)) {
    const Words words = words_of(term);
    const bool contained = std::all_of(words.begin(), words.end(), [&](const std::string& word) { return std::find(query.begin(), query.end(), word) != query.end(); });
    if (words == query) return 0;
    if (contained || begin_words_of(query, words)) best = 1;
  }
  return best;
}

std::string trade_words_text(const Words& query) {
  struct Hit {
    int rank;
    const TradeWord* entry;
  };
  std::vector<Hit> hits;
  for (const TradeWord& entry : trade_words())
    if (const auto rank = rank_of(query, entry)) hits.push_back({*rank, &entry});
  std::stable_sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.rank < b.rank; });
  std::string out;
  for (const auto& [rank, entry] : hits) {
    out += fmt::format("{}:\n  {}\n", entry->words, entry->about);
    if (!entry->see.empty()) out += fmt::format("  see   {}\n", entry->see);
    out += fmt::format("  read  {}\n", entry->page);
  }
  return out;
}

// Calls each(path, field) for all fields of a tree: "contact.pairs[].friction.mu".
template <class Each>
void visit_fields(const Fields& fields, const std::string& prefix, const Each& each) {
  for (const Field& field : fields.all()) {
    each(prefix + field.key, field);
    if (const Shape* inner = nested_object(field.shape)) visit_fields(inner->prototype(), prefix + field.key + (field.shape.form == Shape::Form::object ? "." : "[]."), each);
  }
}

std::string last_key(const std::string& path) { return path.substr(path.rfind('.') == path.npos ? 0 : path.rfind('.') + 1); }

// Keys of components, each with the components that have it.
class ComponentKeys {
 public:
  void add(int rank, const std::string& key, const std::string& doc, const std::string& component) {
    Found& found = keys_[key + "\n" + doc];
    found.rank = rank;
    found.components.push_back(component);
  }
  std::string text() const {
    Section section("keys of components");
    for (const auto& [key, found] : keys_) {
      const size_t end = key.find('\n'), more = found.components.size() - std::min(found.components.size(), shown_components_max);
      const std::vector<std::string> shown(found.components.begin(), found.components.end() - static_cast<long>(more));
      section.add(found.rank, key.substr(0, end), fmt::format("{} ({}{})", key.substr(end + 1), fmt::join(shown, ", "), more > 0 ? fmt::format(" and {} more", more) : ""));
    }
    return section.text();
  }

 private:
  struct Found {
    int rank = 0;
    std::vector<std::string> components;
  };
  std::map<std::string, Found> keys_;  // by key and description
};

void load_if_built(const Kind& kind) {
  try {
    kind.complete();
  } catch (const InputError&) {  // not built: names alone are known
  }
}

std::string components_text(const Words& query) {
  Section kinds("kinds"), components("components (tack list KIND NAME)");
  ComponentKeys keys;
  for (const Kind* kind : registered_kinds()) {
    load_if_built(*kind);
    kinds.offer(query, kind->name(), kind->doc());
    for (const std::string& name : kind->names()) {
      const std::string called = kind->name() + " " + name;
      const auto found = kind->entries().find(name);
      const std::string about = found == kind->entries().end() ? "(in a library that is built when a scene names it)" : found->second.doc;
      if (const auto rank = std::min(rank_of(query, name, about).value_or(3), rank_of(query, called, about).value_or(3)); rank < 3) components.add(rank, called, about);
      if (found == kind->entries().end()) continue;
      visit_fields(kind->prototype(name), "", [&](const std::string& path, const Field& field) {
        if (const auto rank = rank_of(query, last_key(path), "")) keys.add(*rank, path, field.doc, called);
      });
    }
  }
  return kinds.text() + components.text() + keys.text();
}

std::string scene_text(const Words& query, const Fields& scene) {
  Section keys("keys of scenes"), fields("fields of frames (output.fields)");
  visit_fields(scene, "", [&](const std::string& path, const Field& field) {
    const bool lists_fields = path == "output.fields";  // in its description
    if (const auto rank = rank_of(query, last_key(path), lists_fields ? "" : field.doc)) keys.add(*rank, path, lists_fields ? "fields in frames" : field.doc);
    for (const Shape::Option& option : field.shape.options) keys.offer(query, path + ": " + option.name, option.doc);
  });
  for (const FrameFieldInfo& info : frame_fields()) fields.offer(query, info.name, info.doc);
  return keys.text() + fields.text();
}

}  // namespace

std::string search_text(const std::string& query, const SearchSources& sources) {
  const Words words = words_of(query);
  if (words.empty()) return "";
  Section templates("templates (tack new NAME)"), pages("pages");
  for (const SceneTemplate& t : sources.templates) templates.offer(words, t.name, t.about);
  for (const PageHeading& heading : sources.headings)
    if (const auto rank = rank_of(words, heading.text, "")) pages.add(*rank, heading.page, heading.text);
  return trade_words_text(words) + components_text(words) + scene_text(words, *sources.scene) + templates.text() + pages.text();
}

std::string nearest_findable(const std::string& query) {
  std::vector<std::string> names;
  for (const Kind* kind : registered_kinds()) {
    names.push_back(kind->name());
    for (const std::string& name : kind->names()) names.push_back(name);
  }
  for (const TradeWord& entry : trade_words())
    for (const std::string_view term : items_of(entry.words)) names.emplace_back(term);
  std::string lower;
  for (const char c : query) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::string near = nearest(lower, names);
  return near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
}

}  // namespace tack
