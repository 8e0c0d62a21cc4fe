// Work in a child process: each limit ends it, and a busy machine does not.
#include "geometry/isolated_process.hpp"

#include <catch2/catch.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <ctime>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace tack;

namespace {

using End = ProcessResult::End;

constexpr std::uint64_t memory = std::uint64_t(1) << 30;

// Computes until this process has used so much processor time [s].
void compute(double seconds) {
  while (static_cast<double>(std::clock()) / CLOCKS_PER_SEC < seconds) {}
}

// Keeps all processors busy with four threads each, as other runs would.
class BusyMachine {
 public:
  BusyMachine() {
    for (unsigned i = 0; i < 4 * std::max(1U, std::thread::hardware_concurrency()); ++i)
      threads_.emplace_back([this] { while (!done_) {} });
  }
  ~BusyMachine() {
    done_ = true;
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  std::atomic<bool> done_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace

TEST_CASE("a child that computes ends at its limit of processor time", "[isolated]") {
  const ProcessResult result = run_isolated({memory, 0.2, 60}, [] {
    compute(1e9);
    return std::string();
  });
  CHECK(result.end == End::no_processor_time);
}

TEST_CASE("a child that waits ends at its limit of wall time", "[isolated]") {
  const ProcessResult result = run_isolated({memory, 60, 0.3}, []() -> std::string {
    for (;;) ::pause();
  });
  CHECK(result.end == End::no_wall_time);
}

TEST_CASE("a child on a busy machine has its processor time, however long that takes", "[isolated]") {
  const BusyMachine busy;
  const auto start = std::chrono::steady_clock::now();
  const ProcessResult result = run_isolated({memory, 0.5, 60}, [] {
    compute(0.3);
    return std::string("done");
  });
  CHECK(result.end == End::answer);
  CHECK(result.text == "done");
  CHECK(std::chrono::steady_clock::now() - start > std::chrono::milliseconds(500));  // later than its limit
}

TEST_CASE("a child that another program kills has not reached a limit", "[isolated]") {
  const ProcessResult result = run_isolated({memory, 60, 60}, [] {
    ::raise(SIGKILL);
    return std::string();
  });
  CHECK(result.end == End::died);
  CHECK_THAT(result.text, Catch::Matchers::Contains("killed from outside"));
}
