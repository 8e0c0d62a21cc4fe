// Guard under which libraries read and write numbers with a decimal point (strtod, printf), for any
// locale that an embedding program has set (Qt, GTK, Python's locale.setlocale()). It acts on its
// thread during its lifetime.
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
