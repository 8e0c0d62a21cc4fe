// Parallel loops. Work is cut into chunks of a fixed size for any number of threads, and partial
// sums are added in chunk order: the same input gives the same bits. `loop` is the position in the
// source that starts the loop, for observers (loop_observer.hpp).
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <vector>

#include "geometry/loop_observer.hpp"
#include "geometry/thread_count.hpp"

namespace tack {

inline constexpr int chunk_size = 256;

inline int chunk_count(int n, int chunk = chunk_size) { return (n + chunk - 1) / chunk; }

namespace detail {

// Not inlined: the scheduler calls a body at several code positions, and copies optimised
// separately may contract products and sums differently.
template <class Body>
[[gnu::noinline]] void run_chunks(int first, int last, int n, int chunk, const Body& body) {
  for (int c = first; c < last; ++c)
    body(c, c * chunk, c * chunk + chunk < n ? c * chunk + chunk : n);
}

}  // namespace detail

// Calls body(chunk index, first, last) for each chunk of [0, n).
template <class Body>
void for_each_chunk(int n, const Body& body, int chunk = chunk_size,
                    SourcePosition loop = SourcePosition::current()) {
  const int chunks = chunk_count(n, chunk);
  if (loop_observer) [[unlikely]] {
    const auto run = [&](int c) { detail::run_chunks(c, c + 1, n, chunk, body); };
    loop_observer->run(loop, chunks, ChunkCall(run));
    return;
  }
  if (chunks <= 1 || thread_count() <= 1) {
    detail::run_chunks(0, chunks, n, chunk, body);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<int>(0, chunks, 1), [&](const tbb::blocked_range<int>& r) {
    detail::run_chunks(r.begin(), r.end(), n, chunk, body);
  });
}

// Calls body(i) for each i of [0, n).
template <class Body>
void for_each(int n, const Body& body, int chunk = chunk_size,
              SourcePosition loop = SourcePosition::current()) {
  for_each_chunk(
      n,
      [&](int, int first, int last) {
        for (int i = first; i < last; ++i) body(i);
      },
      chunk, loop);
}

// Returns the sum over chunks of body(first, last), in chunk order.
template <class Body>
double sum_chunks(int n, const Body& body, int chunk = chunk_size,
                  SourcePosition loop = SourcePosition::current()) {
  std::vector<double> partial(chunk_count(n, chunk), 0.0);
  for_each_chunk(
      n, [&](int c, int first, int last) { partial[c] = body(first, last); }, chunk, loop);
  double sum = 0;
  for (const double s : partial) sum += s;
  return sum;
}

// Returns the minimum of `start` and body(first, last) over all chunks.
template <class Body>
double min_chunks(int n, double start, const Body& body, int chunk = chunk_size,
                  SourcePosition loop = SourcePosition::current()) {
  std::vector<double> partial(chunk_count(n, chunk), start);
  for_each_chunk(
      n, [&](int c, int first, int last) { partial[c] = body(first, last); }, chunk, loop);
  double smallest = start;
  for (const double s : partial) smallest = s < smallest ? s : smallest;
  return smallest;
}

// Returns the maximum of `start` and body(first, last) over all chunks.
template <class Body>
double max_chunks(int n, double start, const Body& body, int chunk = chunk_size,
                  SourcePosition loop = SourcePosition::current()) {
  const auto negative = [&](int first, int last) { return -body(first, last); };
  return -min_chunks(n, -start, negative, chunk, loop);
}

}  // namespace tack
