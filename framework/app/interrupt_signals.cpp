#include "framework/app/interrupt_signals.hpp"

#include <csignal>
#include <thread>

#include "geometry/interrupt.hpp"

// Function of OpenBLAS, which no header declares; other builds of OpenBLAS may lack it.
extern "C" [[gnu::weak]] int blas_thread_shutdown_();  // NOLINT(readability-identifier-naming): the name is theirs

namespace tack {
namespace {

extern "C" void request_interrupt(int) { interrupt_requested = true; }

bool ignored(int signal) {
  struct sigaction action{};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void let_signals_interrupt() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (signal == SIGHUP && ignored(signal)) continue;
    sigaddset(&signals, signal);
    std::signal(signal, request_interrupt);  // for threads that a library has already started
  }
  // The kernel sends these to the thread that writes, so that no other thread can wait for them;
  // its write fails with EPIPE or EFBIG.
  for (const int signal : {SIGPIPE, SIGXFSZ})
    if (!ignored(signal)) std::signal(signal, request_interrupt);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  // The threads of OpenBLAS existed before the mask was set; it starts new ones when needed.
  if (blas_thread_shutdown_) blas_thread_shutdown_();
  std::thread([signals] {
    for (int signal = 0;; ) if (::sigwait(&signals, &signal) == 0) interrupt_requested = true;
  }).detach();
}

}  // namespace tack
