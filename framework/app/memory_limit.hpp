// How much memory a run may have, as `--memory` says: what asks for more fails with std::bad_alloc, instead of making the whole
// machine slow or being killed with what else is on it.
#pragma once

namespace tack {

// Throws InputError if the limit of the address space (RLIMIT_AS) leaves too little for the program and for linear algebra in so many threads: OpenBLAS
// asks for its buffers for ever, deaf to signals, and does not let the process end. 0 threads: for its own, which are there before main().
void check_address_space(int threads);

// Of this process, from now on: so many bytes of data, of which it has some already. `threads`: that may compute side by side. Throws
// InputError if that is less than the program itself takes.
void limit_memory(double bytes, int threads);

}  // namespace tack
