// Signals that end a run in an orderly way (geometry/interrupt.hpp): Ctrl-C, `kill`, the end of the
// terminal, SIGPIPE (the reader of the output goes away) and SIGXFSZ (a limit of file sizes).
#pragma once

namespace tack {

// From now on those signals, but SIGHUP where the caller ignores it (nohup), are blocked in this thread and all that it starts, and one thread
// waits for them: a handler would not do, METIS has its own for SIGTERM while it orders a matrix, which leaves METIS by a jump and nothing else.
// Call it before threads are started. Programs that are started inherit what is blocked.
void let_signals_interrupt();

}  // namespace tack
