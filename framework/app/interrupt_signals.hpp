// Ctrl-C, `kill` and the end of the terminal end what runs in an orderly way (geometry/interrupt.hpp).
#pragma once

#include <csignal>

#include "geometry/interrupt.hpp"

namespace tack {

extern "C" inline void request_interrupt(int) { interrupt_requested = true; }

inline void let_signals_interrupt() {
  std::signal(SIGINT, request_interrupt);
  std::signal(SIGTERM, request_interrupt);
  if (std::signal(SIGHUP, request_interrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
}

}  // namespace tack
