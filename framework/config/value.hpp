// A node of a parsed scene file, with its source location. Hides the YAML library from other
// headers. Maps keep the order of the file.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tack {

// Source location of a value. Line and column count from 1. Line 0: the value is in no file (`--set
// a.b=c`), and `file` names its origin.
struct SourceMark {
  std::shared_ptr<const std::string> file;
  int line = 0;
  int column = 0;

  std::string text() const;  // "scene.yaml:12:5"
};

struct Value {
  enum class Kind { null, scalar, sequence, map };
  struct Entry;

  Kind kind = Kind::null;
  std::string text;            // scalar, as written, without quotes
  std::vector<Value> items;    // sequence
  std::vector<Entry> entries;  // map
  SourceMark mark;
  std::string comment;  // written after the value by yaml_text, such as its unit

  static Value scalar(std::string text);
  static Value number(double value);  // shortest text that reads back as the same bits
  static Value sequence();
  static Value sequence(std::vector<Value> items);
  static Value map();

  bool is_null() const { return kind == Kind::null; }
  bool is_scalar() const { return kind == Kind::scalar; }
  bool is_sequence() const { return kind == Kind::sequence; }
  bool is_map() const { return kind == Kind::map; }

  // Returns the value under `key`; nullptr if this is no map or has no such key.
  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);

  // Replaces the value under `key`, or appends it. Returns the stored value.
  Value& set(std::string key, Value value);

  // Returns "'5 mm'", "a list of 2", "a map" or "nothing", for messages.
  std::string description() const;
};

struct Value::Entry {
  std::string key;
  SourceMark mark;  // of the key
  Value value;
};

}  // namespace tack
