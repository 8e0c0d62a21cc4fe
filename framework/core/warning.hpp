// What a run tells of and goes on with, but what may make its results worth less than they seem.
#pragma once

#include <functional>
#include <string>
#include <utility>

namespace tack {

struct Warning {
  std::string text;  // a line
  // What recurs from step to step: records have the first of a kind, and how often there were more. "": each is told by itself.
  std::string kind;

  Warning(std::string what, std::string of_kind = "") : text(std::move(what)), kind(std::move(of_kind)) {}
  operator const std::string&() const { return text; }  // for those who only print it
};

// What a run has warned of: the first of a kind, and how often there was one.
struct WarningCount {
  Warning first;
  int times = 1;
};

using WarningFunction = std::function<void(const Warning&)>;

}  // namespace tack
