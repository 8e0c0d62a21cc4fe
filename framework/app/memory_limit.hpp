// The memory limit of a run (`--memory`): an allocation beyond it fails with std::bad_alloc,
// instead of slowing down the machine or getting the process killed together with others.
#pragma once

namespace tack {

// Throws InputError if the limit of the address space (RLIMIT_AS) is too small for the program and
// for linear algebra on `threads` threads. Otherwise OpenBLAS requests its buffers forever: it
// ignores signals, and the process does not end. `threads` = 0 stands for the threads of OpenBLAS
// itself, which exist before main().
void check_address_space(int threads);

// Limits the data segment of this process (RLIMIT_DATA) to `bytes` more than its untouched memory.
// `threads`: threads that may compute at the same time. Throws InputError if the limit is below the
// memory that the program itself takes.
void limit_memory(double bytes, int threads);

}  // namespace tack
