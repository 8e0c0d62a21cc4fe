// How much memory a run may have, as `--memory` says: what asks for more fails with std::bad_alloc, instead of making the whole
// machine slow or being killed with what else is on it.
#pragma once

namespace tack {

// Of this process, from now on: so many bytes of data, of which it has some already. `threads`: that may compute side by side. Throws
// InputError if that is less than the program itself takes.
void limit_memory(double bytes, int threads);

}  // namespace tack
