#include "python/bindings/interrupts.hpp"

#include <csignal>
#include <mutex>

#include "geometry/interrupt.hpp"

namespace tack::python {
namespace {

std::mutex guard;
int living = 0;
bool caught = false;
struct sigaction before{};

extern "C" void request_interrupt(int signal) {
  interrupt_requested = true;
  before.sa_handler(signal);
}

}  // namespace

Interrupts::Interrupts() {
  const std::lock_guard lock(guard);
  if (living++ > 0) return;
  interrupt_requested = false;
  ::sigaction(SIGINT, nullptr, &before);
  // Leaves processes alone that ignore the signal or end on it.
  caught = !(before.sa_flags & SA_SIGINFO) && before.sa_handler != SIG_IGN && before.sa_handler != SIG_DFL;
  if (!caught) return;
  struct sigaction action = before;
  action.sa_handler = request_interrupt;
  ::sigaction(SIGINT, &action, nullptr);
}

Interrupts::~Interrupts() {
  const std::lock_guard lock(guard);
  if (--living > 0) return;
  if (caught) ::sigaction(SIGINT, &before, nullptr);
  interrupt_requested = false;
}

}  // namespace tack::python
