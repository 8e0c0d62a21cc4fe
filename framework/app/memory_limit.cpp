#include "framework/app/memory_limit.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <fstream>
#include <string>
#include <vector>

#include "geometry/errors.hpp"

// Of OpenBLAS, without a header; other builds of it may not have them.
extern "C" {
[[gnu::weak]] void* blas_memory_alloc(int place);
[[gnu::weak]] void blas_memory_free(void* buffer);
[[gnu::weak]] int openblas_get_num_threads();
}

namespace tack {
namespace {

// OpenBLAS asks for a buffer when a thread first needs one, and asks for ever if it gets none. What it has once it keeps. Its own threads may
// not have come to ask for theirs yet.
void give_blas_its_buffers(int threads) {
  if (!blas_memory_alloc || !blas_memory_free || !openblas_get_num_threads) return;
  std::vector<void*> buffers;
  for (int i = 0; i < threads + openblas_get_num_threads(); ++i) buffers.push_back(blas_memory_alloc(0));
  for (void* buffer : buffers) blas_memory_free(buffer);
}

// Bytes of this process: "VmData", all that it may write into, "RssAnon", what it has written into. 0 if the kernel does not tell.
double status(const std::string& what) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(what + ":")) return 1024 * std::stod(line.substr(what.size() + 1));
  return 0;
}

}  // namespace

void limit_memory(double bytes, int threads) {
  constexpr double least = 32e6;  // bytes to work with
  give_blas_its_buffers(threads);
  // The kernel counts what was asked for, the limit what is used: untouched buffers and stacks do not count.
  const double used = status("RssAnon"), untouched = status("VmData") - used;
  if (bytes < used + least)
    throw InputError(fmt::format("memory: {:.3g} GB is less than the program takes before it has read a scene; give at least {:.2g} GB",
                                 bytes / 1e9, (used + least) / 1e9));
  const auto most = static_cast<rlim_t>(bytes + untouched);
  const rlimit limit{most, most};
  ::setrlimit(RLIMIT_DATA, &limit);
}

}  // namespace tack
