// Ctrl-C during calls of tack: sets a flag that its loops check, besides Python's own handler. In a
// process that runs one case, SIGTERM does too.
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

// SIGTERM ends all calls of tack from now on, the present one and later ones, as Ctrl-C does: with
// everything written. Blocks the signal in this thread and all threads that it starts; one thread
// waits for it, since METIS installs a handler of its own (framework/app/interrupt_signals.hpp).
// The process no longer ends by SIGTERM itself. Call it in the main thread.
void let_termination_interrupt();

}  // namespace tack::python
