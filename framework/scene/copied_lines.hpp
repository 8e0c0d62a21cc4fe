// Warnings about objects, of which the copies of one object (fill.hpp) share one per kind.
#pragma once

#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "framework/core/warning.hpp"
#include "framework/scene/scene_config.hpp"

namespace tack {

class CopiedLines {
 public:
  void add(const ObjectConfig& object, WarningKind kind, std::string line) {
    const std::string group = copies_of(object);
    if (!group.empty()) {
      const auto [found, first] = line_of_.emplace(std::pair(group, kind), lines_.size());
      if (!first) {
        ++lines_[found->second].more;
        return;
      }
    }
    lines_.push_back({kind, std::move(line), group});
  }

  std::vector<Warning> warnings() const {
    std::vector<Warning> warnings;
    for (const Line& line : lines_)
      warnings.emplace_back(
          line.kind, line.more == 0 ? line.text
                                    : fmt::format("{} (and so it is for {} more copies of '{}')",
                                                  line.text, line.more, line.group));
    return warnings;
  }

 private:
  // Returns the entry that an object is a copy of: the last of its groups, if its name is that
  // group and a number; else "".
  static std::string copies_of(const ObjectConfig& object) {
    if (object.groups.empty() || !object.name.starts_with(object.groups.back() + "_")) return "";
    return object.groups.back();
  }

  struct Line {
    WarningKind kind;
    std::string text, group;
    int more = 0;  // further copies that share the line
  };

  std::map<std::pair<std::string, WarningKind>, size_t> line_of_;  // by group and kind
  std::vector<Line> lines_;
};

}  // namespace tack
