#include "python/bindings/interrupts.hpp"

#include <atomic>
#include <csignal>
#include <mutex>
#include <thread>

#include "geometry/interrupt.hpp"

namespace tack::python {
namespace {

std::mutex guard;
int living = 0;
bool caught = false;
struct sigaction before{};
std::atomic<bool> terminated{false};  // stays true: the process has been asked to end

extern "C" void request_interrupt(int signal) {
  interrupt_requested = true;
  before.sa_handler(signal);
}

extern "C" void request_termination(int) {
  terminated = true;
  interrupt_requested = true;
}

// Forgets Ctrl-C, but not SIGTERM. SIGTERM between these lines is not lost: `terminated` is set
// before `interrupt_requested`.
void reset_interrupt() {
  interrupt_requested = false;
  if (terminated) interrupt_requested = true;
}

}  // namespace

Interrupts::Interrupts() {
  const std::lock_guard lock(guard);
  if (living++ > 0) return;
  reset_interrupt();
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
  reset_interrupt();
}

void let_termination_interrupt() {
  static std::once_flag once;
  std::call_once(once, [] {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGTERM);
    std::signal(SIGTERM, request_termination);  // for threads that a library has already started
    ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    std::thread([signals] {
      for (int signal = 0;;)
        if (::sigwait(&signals, &signal) == 0) request_termination(signal);
    }).detach();
  });
}

}  // namespace tack::python
