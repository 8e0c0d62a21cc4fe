// Warnings of a run: conditions that do not stop it but may reduce the quality of its results.
#pragma once

#include <functional>
#include <string>
#include <utility>

namespace tack {

/// One warning.
struct Warning {
  std::string text;  // one line
  // Kind of a warning that recurs from step to step: records keep the first of each kind and count
  // the others. "": every warning is recorded.
  std::string kind;

  Warning(std::string what, std::string of_kind = "")
      : text(std::move(what)), kind(std::move(of_kind)) {}
  operator const std::string&() const { return text; }  // for printing
};

/// The first warning of a kind, and the number of warnings of that kind.
struct WarningCount {
  Warning first;
  int times = 1;
};

using WarningFunction = std::function<void(const Warning&)>;

}  // namespace tack
