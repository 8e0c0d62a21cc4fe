#include "framework/config/parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

#include "framework/config/read_file.hpp"
#include "framework/config/yaml_reader.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

// Limit of values: includes of includes can grow exponentially, and no scene comes near this
// number.
constexpr std::size_t values_max = 1'000'000;

// State of reading a file with its includes.
struct Reading {
  struct File {
    fs::path written, canonical;
  };
  std::vector<File> chain;           // files being read, outermost first
  std::map<fs::path, Value> ready;   // included files with their includes merged, each read once
};

std::string read_included(const Value& file, const fs::path& path) {
  try {
    return read_file(path, largest_text);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: include: {}", file.mark.text(), error.what()));
  }
}

std::vector<Value> included_files(const Value& include) {
  std::vector<Value> files =
      include.is_sequence() ? include.items : std::vector<Value>{include};
  for (const Value& file : files) {
    if (file.is_scalar()) continue;
    throw InputError(fmt::format("{}: include: expects a file name or a list of them, got {}",
                                 file.mark.text(), file.description()));
  }
  return files;
}

void refuse_cycle(const Reading& reading, const Reading::File& file, const SourceMark& mark) {
  const auto same = [&](const Reading::File& f) { return f.canonical == file.canonical; };
  const auto first = std::find_if(reading.chain.begin(), reading.chain.end(), same);
  if (first == reading.chain.end()) return;
  std::string cycle;
  for (auto f = first; f != reading.chain.end(); ++f) cycle += f->written.string() + " -> ";
  throw InputError(fmt::format("{}: include: files include each other: {}{}", mark.text(), cycle,
                               file.written.string()));
}

Value expand_includes(Value root, Reading& reading);

const Value& load_included(const Value& file, Reading& reading) {
  const fs::path path = (reading.chain.back().written.parent_path() / file.text).lexically_normal();
  if (const auto known = reading.ready.find(path); known != reading.ready.end()) return known->second;
  const Reading::File included{path, fs::weakly_canonical(path)};
  refuse_cycle(reading, included, file.mark);
  const std::string text = read_included(file, path);
  reading.chain.push_back(included);
  Value v = expand_includes(read_yaml(text, path.string()), reading);
  reading.chain.pop_back();
  return reading.ready.emplace(path, std::move(v)).first->second;
}

Value expand_includes(Value root, Reading& reading) {
  if (root.is_null()) root.kind = Value::Kind::map;  // an empty file sets nothing
  const auto is_include = [](const Value::Entry& e) { return e.key == "include"; };
  const auto entry = std::find_if(root.entries.begin(), root.entries.end(), is_include);
  if (entry == root.entries.end()) return root;
  Value merged = Value::map();
  for (const Value& file : included_files(entry->value)) {
    merge(merged, load_included(file, reading));
    if (count_values(merged) > values_max)
      throw InputError(fmt::format("{}: include: makes more than {} values of what it includes; include each file once", file.mark.text(), values_max));
  }
  root.entries.erase(entry);
  merge(merged, std::move(root));
  return merged;
}

}  // namespace

Value parse_file(const std::string& path) {
  return parse_string(read_file(path, largest_text), path);
}

Value parse_string(const std::string& text, const std::string& name) {
  Reading reading{{{name, fs::weakly_canonical(name)}}, {}};
  return expand_includes(read_yaml(text, name), reading);
}

std::string resolve_path(const SourceMark& mark, const std::string& path) {
  if (path.empty()) return path;
  const bool in_file = mark.file && mark.line > 0;
  const fs::path folder = in_file ? fs::path(*mark.file).parent_path() : fs::path();
  return fs::absolute(folder / path).lexically_normal().string();
}

}  // namespace tack
