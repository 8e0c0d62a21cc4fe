// Signals that end a run in an orderly way (geometry/interrupt.hpp): Ctrl-C, `kill`, the end of the
// terminal, SIGPIPE (the output pipe is closed) and SIGXFSZ (a limit of file sizes).
#pragma once

namespace tack {

// Blocks these signals (SIGHUP only if the caller does not ignore it, as nohup does) in this thread
// and all threads that it starts; one thread waits for them. A handler would not do: METIS installs
// its own for SIGTERM while it orders a matrix, which jumps out of METIS and does nothing else.
// Call it before threads are started. Child processes inherit the blocked signals.
void let_signals_interrupt();

}  // namespace tack
