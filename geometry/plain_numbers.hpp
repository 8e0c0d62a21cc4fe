// Numbers with a decimal point for libraries that read and write them by the locale (strtod,
// printf), whatever locale an embedding program has set: Qt, GTK and Python's locale.setlocale()
// do. The guard acts on its thread, while it lives.
#pragma once

#include <clocale>
#include <locale.h>

namespace tack {

class PlainNumbers {
 public:
  PlainNumbers() : before_(::uselocale(plain())) {}
  ~PlainNumbers() { ::uselocale(before_); }
  PlainNumbers(const PlainNumbers&) = delete;
  PlainNumbers& operator=(const PlainNumbers&) = delete;

 private:
  static locale_t plain() {
    static const locale_t c = ::newlocale(LC_ALL_MASK, "C", locale_t{});
    return c;
  }
  locale_t before_;
};

}  // namespace tack
