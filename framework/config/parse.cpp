#include "framework/config/parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "framework/config/read_file.hpp"
#include "framework/config/yaml_reader.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

// The files being read, outermost first, as they were written; compared in canonical form.
using Chain = std::vector<fs::path>;

std::string read_included(const Value& file, const fs::path& path) {
  try {
    return read_file(path, largest_text);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: include: {}", file.mark.text(), error.what()));
  }
}

std::vector<Value> included_files(const Value& include) {
  const std::vector<Value> files =
      include.is_sequence() ? include.items : std::vector<Value>{include};
  for (const Value& file : files) {
    if (file.is_scalar()) continue;
    throw InputError(fmt::format("{}: include: expects a file name or a list of them, got {}",
                                 file.mark.text(), file.description()));
  }
  return files;
}

void refuse_cycle(const Chain& chain, const fs::path& path, const SourceMark& mark) {
  const auto same = [&](const fs::path& p) {
    return fs::weakly_canonical(p) == fs::weakly_canonical(path);
  };
  const auto first = std::find_if(chain.begin(), chain.end(), same);
  if (first == chain.end()) return;
  std::string cycle;
  for (auto p = first; p != chain.end(); ++p) cycle += p->string() + " -> ";
  throw InputError(fmt::format("{}: include: files include each other: {}{}", mark.text(), cycle,
                               path.string()));
}

Value expand_includes(Value root, Chain& chain);

Value load_included(const Value& file, Chain& chain) {
  const fs::path path = (chain.back().parent_path() / file.text).lexically_normal();
  refuse_cycle(chain, path, file.mark);
  const std::string text = read_included(file, path);
  chain.push_back(path);
  Value v = expand_includes(read_yaml(text, path.string()), chain);
  chain.pop_back();
  return v;
}

Value expand_includes(Value root, Chain& chain) {
  if (root.is_null()) root.kind = Value::Kind::map;  // an empty file sets nothing
  const auto is_include = [](const Value::Entry& e) { return e.key == "include"; };
  const auto entry = std::find_if(root.entries.begin(), root.entries.end(), is_include);
  if (entry == root.entries.end()) return root;
  Value merged = Value::map();
  for (const Value& file : included_files(entry->value)) merge(merged, load_included(file, chain));
  root.entries.erase(entry);
  merge(merged, std::move(root));
  return merged;
}

}  // namespace

Value parse_file(const std::string& path) {
  return parse_string(read_file(path, largest_text), path);
}

Value parse_string(const std::string& text, const std::string& name) {
  Chain chain{name};
  return expand_includes(read_yaml(text, name), chain);
}

std::string resolve_path(const SourceMark& mark, const std::string& path) {
  if (path.empty()) return path;
  const bool in_file = mark.file && mark.line > 0;
  const fs::path folder = in_file ? fs::path(*mark.file).parent_path() : fs::path();
  return fs::absolute(folder / path).lexically_normal().string();
}

}  // namespace tack
