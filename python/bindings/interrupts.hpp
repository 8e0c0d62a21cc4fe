// Ctrl-C during calls of tack: sets a flag that its loops check, besides Python's own handler.
#pragma once

namespace tack::python {

// Handles Ctrl-C while an instance exists. With several instances, in threads, the first one
// installs the handler and the last one removes it.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;
};

}  // namespace tack::python
