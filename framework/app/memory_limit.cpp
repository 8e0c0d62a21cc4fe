#include "framework/app/memory_limit.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "geometry/errors.hpp"

// Functions of OpenBLAS, which no header declares; other builds of OpenBLAS may lack them.
extern "C" {
[[gnu::weak]] void* blas_memory_alloc(int place);
[[gnu::weak]] void blas_memory_free(void* buffer);
[[gnu::weak]] int openblas_get_num_threads();
}

namespace tack {
namespace {

// OpenBLAS requests a buffer when a thread first needs one, and requests it forever if it gets
// none. It never releases its buffers. Its own threads may not have requested theirs yet.
void give_blas_its_buffers(int threads) {
  if (!blas_memory_alloc || !blas_memory_free || !openblas_get_num_threads) return;
  std::vector<void*> buffers;
  for (int i = 0; i < threads + openblas_get_num_threads(); ++i) buffers.push_back(blas_memory_alloc(0));
  for (void* buffer : buffers) blas_memory_free(buffer);
}

// Buffer that OpenBLAS maps for each calling thread: its BUFFER_SIZE on x86-64, 32 << 22 bytes.
constexpr double blas_buffer = 134217728;

// Returns a memory size of this process in bytes, 0 if the kernel does not report it:
// - "VmSize": all mapped memory
// - "VmData": all writable private memory
// - "RssAnon": all private memory that was written to
double status(const std::string& what) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(what + ":")) {
      long kilobytes = 0;
      const size_t number = line.find_first_of("0123456789");
      if (number != line.npos) std::from_chars(line.data() + number, line.data() + line.size(), kilobytes);
      return 1024.0 * static_cast<double>(kilobytes);
    }
  return 0;
}

}  // namespace

void check_address_space(int threads) {
  rlimit limit{};
  if (!blas_memory_alloc || !openblas_get_num_threads || ::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  constexpr double rest = 32e6;  // bytes: stacks, a small scene
  const double mapped = status("VmSize"), had = std::floor(status("VmData") / blas_buffer);
  const double needed = mapped - had * blas_buffer + (openblas_get_num_threads() - 1 + threads) * blas_buffer + rest;
  if (static_cast<double>(limit.rlim_cur) < needed)
    throw InputError(fmt::format("the address space is limited to {:.0f} MB (ulimit -v, h_vmem of SGE, vmem of PBS), and with {} the program and its linear algebra map {:.0f} MB "
                                 "before they have read a scene; raise that limit, or take --threads 1 and OPENBLAS_NUM_THREADS=1",
                                 static_cast<double>(limit.rlim_cur) / 1e6, threads > 1 ? fmt::format("{} threads", threads) : "a thread", needed / 1e6));
}

void limit_memory(double bytes, int threads) {
  constexpr double least = 32e6;  // bytes to work with
  give_blas_its_buffers(threads);
  // The kernel counts allocated memory, the limit used memory: untouched buffers and stacks do not
  // count.
  const double used = status("RssAnon"), untouched = status("VmData") - used;
  if (bytes < used + least)
    throw InputError(fmt::format("memory: {:.3g} GB is less than the program takes before it has read a scene; give at least {:.2g} GB",
                                 bytes / 1e9, (used + least) / 1e9));
  const auto most = static_cast<rlim_t>(bytes + untouched);
  const rlimit limit{most, most};
  ::setrlimit(RLIMIT_DATA, &limit);
}

}  // namespace tack
