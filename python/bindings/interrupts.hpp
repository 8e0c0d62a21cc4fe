// Ctrl-C while tack works: a flag that its loops look at, beside what Python does about it.
#pragma once

namespace tack::python {

// While any lives; of several at once, in threads, the first begins and the last ends it.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;
};

}  // namespace tack::python
