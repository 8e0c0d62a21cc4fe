// How much memory a run may have, as `--memory` says: what asks for more fails with std::bad_alloc, instead of making the whole
// machine slow or being killed with what else is on it.
#pragma once

namespace tack {

// Throws InputError if the limit of the address space (RLIMIT_AS) is too small for the program and
// for linear algebra on `threads` threads. Otherwise OpenBLAS requests its buffers forever: it
// ignores signals, and the process does not end. `threads` = 0 stands for the threads of OpenBLAS
// itself, which exist before main().
void check_address_space(int threads);

// Of this process, from now on: so many bytes of data, of which it has some already. `threads`: that may compute side by side. Throws
// InputError if that is less than the program itself takes.
void limit_memory(double bytes, int threads);

}  // namespace tack
