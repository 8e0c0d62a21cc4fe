// Warnings of a run: conditions that do not stop it but may reduce the quality of its results.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <utility>

#include "framework/core/warning_kind.hpp"

namespace tack {

/// One warning.
struct Warning {
  WarningKind kind;
  std::string text;  // one line
  // Name of the object, joint or group that the warning is about, if several may have warnings of a
  // kind that recurs; else "".
  std::string subject = "";

  Warning(WarningKind of_kind, std::string line, std::string about = "")
      : kind(of_kind), text(std::move(line)), subject(std::move(about)) {}
  operator const std::string&() const { return text; }  // for printing
  bool operator==(const Warning&) const = default;
};

inline std::ostream& operator<<(std::ostream& out, const Warning& warning) {
  return out << entry_of(warning.kind).key << ": " << warning.text;
}

/// Returns whether records count `b` with `a`: warnings of a kind that recurs have the same
/// subject, others the same text.
inline bool counted_together(const Warning& a, const Warning& b) {
  return a.kind == b.kind && (entry_of(a.kind).recurs ? a.subject == b.subject : a.text == b.text);
}

/// The first of the warnings that are counted together, and their number.
struct WarningCount {
  Warning first;
  int times = 1;
};

using WarningFunction = std::function<void(const Warning&)>;

}  // namespace tack
