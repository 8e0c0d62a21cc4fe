// Position of a call in the source.
#pragma once

#include <cstdint>
#include <source_location>

namespace tack {

#ifdef __cpp_lib_source_location
using SourcePosition = std::source_location;
#else
/// Stands in for std::source_location with Clang 14, for which libstdc++ has none. The name of the
/// function is without its class, parameters and template arguments.
class SourcePosition {
 public:
  static constexpr SourcePosition current(const char* file = __builtin_FILE(),
                                          const char* function = __builtin_FUNCTION(),
                                          std::uint_least32_t line = __builtin_LINE()) {
    SourcePosition position;
    position.file_ = file;
    position.function_ = function;
    position.line_ = line;
    return position;
  }
  constexpr const char* file_name() const { return file_; }
  constexpr const char* function_name() const { return function_; }
  constexpr std::uint_least32_t line() const { return line_; }

 private:
  const char* file_ = "";
  const char* function_ = "";
  std::uint_least32_t line_ = 0;
};
#endif

}  // namespace tack
