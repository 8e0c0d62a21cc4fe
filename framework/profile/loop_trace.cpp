#include "framework/profile/loop_trace.hpp"

#include <algorithm>
#include <deque>
#include <functional>
#include <numeric>
#include <queue>
#include <tuple>

namespace tack {
namespace {

// A chunk: segments with a loop after each but the last one.
struct Chunk {
  int parent = -1;
  std::vector<double> segments;         // s
  std::vector<std::vector<int>> loops;  // their chunks
};

// Runs chunks on cores, from event to event.
class ChunkSchedule {
 public:
  ChunkSchedule(const std::vector<Chunk>& chunks, int cores) : chunks_(chunks), state_(chunks.size()), idle_(cores) {}

  double run(const std::vector<int>& outermost) {
    ready_.assign(outermost.begin(), outermost.end());
    double now = 0;
    while (true) {
      for (; idle_ > 0 && !ready_.empty(); --idle_, ready_.pop_front()) {
        const int chunk = ready_.front();
        running_.emplace(now + chunks_[chunk].segments[state_[chunk].segment], order_++, chunk);
      }
      if (running_.empty()) return now;
      now = std::get<0>(running_.top());
      const int chunk = std::get<2>(running_.top());
      running_.pop();
      ++idle_;
      end_segment(chunk);
    }
  }

 private:
  void end_segment(int chunk) {
    State& state = state_[chunk];
    const std::vector<std::vector<int>>& loops = chunks_[chunk].loops;
    if (const size_t loop = state.segment++; loop < loops.size()) {
      state.open = loops[loop].size();
      ready_.insert(ready_.begin(), loops[loop].begin(), loops[loop].end());
    } else if (const int parent = chunks_[chunk].parent; parent >= 0 && --state_[parent].open == 0) {
      ready_.push_front(parent);
    }
  }

  struct State {
    size_t segment = 0;  // that runs, or is next
    size_t open = 0;     // chunks of its loop that have not ended
  };
  using End = std::tuple<double, long, int>;  // time, order of the starts, chunk
  const std::vector<Chunk>& chunks_;
  std::vector<State> state_;
  std::deque<int> ready_;
  std::priority_queue<End, std::vector<End>, std::greater<>> running_;
  int idle_;
  long order_ = 0;
};

}  // namespace

double scheduled(const std::vector<double>& chunks, int cores, const ChunkOrder* order) {
  if (chunks.empty()) return 0;
  if (!order && chunks.size() <= static_cast<size_t>(cores)) return *std::max_element(chunks.begin(), chunks.end());
  std::vector<double> idle_at(cores, 0.0);  // heap, earliest first
  const auto take = [&](const auto& run) {
    std::pop_heap(idle_at.begin(), idle_at.end(), std::greater<>());
    run(idle_at.back());
    std::push_heap(idle_at.begin(), idle_at.end(), std::greater<>());
  };
  if (!order) {
    for (const double chunk : chunks) take([&](double& at) { at += chunk; });
    return *std::max_element(idle_at.begin(), idle_at.end());
  }
  std::vector<double> end_of(chunks.size());
  for (size_t s = 0; s + 1 < order->strip_start.size(); ++s)
    take([&](double& at) {
      for (size_t c = order->strip_start[s]; c < std::min<size_t>(order->strip_start[s + 1], chunks.size()); ++c) {
        for (int k = order->start[c]; k < order->start[c + 1]; ++k) at = std::max(at, end_of[order->before[k]]);
        end_of[c] = at += chunks[c];
      }
    });
  return *std::max_element(end_of.begin(), end_of.end());
}

void lower_longest(std::vector<double>& seconds, double total) {
  if (std::accumulate(seconds.begin(), seconds.end(), 0.0) <= total) return;
  std::vector<double> ascending = seconds;
  std::sort(ascending.begin(), ascending.end());
  double left = std::max(total, 0.0), limit = 0;
  for (size_t i = 0; i < ascending.size(); ++i) {
    limit = left / static_cast<double>(ascending.size() - i);
    if (ascending[i] >= limit) break;
    left -= ascending[i];
  }
  for (double& time : seconds) time = std::min(time, limit);
}

void LoopTrace::clear() {
  seconds_.clear();
  marks_.clear();
  nested_ = false;
}

double LoopTrace::seconds() const { return std::accumulate(seconds_.begin(), seconds_.end(), 0.0); }

double LoopTrace::scheduled(int cores, const ChunkOrder* order) const {
  if (!nested_) return tack::scheduled(seconds_, cores, order);
  std::vector<Chunk> chunks;
  std::vector<int> outermost;
  std::vector<int> open;  // chunks around the present position, the innermost last; -1: between chunks
  open.push_back(-1);
  size_t segment = 0;
  for (const Mark mark : marks_) switch (mark) {
      case Mark::segment:
        if (open.back() < 0) {  // the first one of a chunk
          open.back() = static_cast<int>(chunks.size());
          const int parent = open.size() > 1 ? open[open.size() - 2] : -1;
          (parent < 0 ? outermost : chunks[parent].loops.back()).push_back(open.back());
          chunks.push_back({parent, {}, {}});
        }
        chunks[open.back()].segments.push_back(seconds_[segment++]);
        break;
      case Mark::end_chunk: open.back() = -1; break;
      case Mark::begin_loop:
        chunks[open.back()].loops.emplace_back();
        open.push_back(-1);
        break;
      case Mark::end_loop: open.pop_back(); break;
    }
  return ChunkSchedule(chunks, cores).run(outermost);
}

}  // namespace tack
