#include "framework/output/progress.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <sstream>

using namespace tack;

namespace {

// A run of 10 s whose progress goes to strings, with a clock set by the test.
struct Told {
  std::ostringstream out;
  std::ostringstream log;
  double now = 100;
  Progress progress;

  explicit Told(Verbosity verbosity, int live_width = 0)
      : progress(out, &log, {verbosity, live_width, [this] { return now; }}) {
    progress.begin(0, 10);
  }
};

StepReport report(int step, double time) {
  StepReport r;
  r.step = step;
  r.time = time;
  r.solve.iterations = 4;
  r.contacts = 310;
  r.min_distance = 1e-5;  // within one object
  r.min_gap = 1.25e-4;
  r.converged = true;
  return r;
}

const std::string line_120 =
    "step 120  t 4 s (40%)  4 iterations  310 contacts  gap 0.000125 m  1m30s left";

}  // namespace

TEST_CASE("a step is reported in one line") {
  Told told(Verbosity::verbose);
  told.now += 60;
  told.progress.step(report(120, 4));
  CHECK(told.out.str() == line_120 + "\n");
  CHECK(told.log.str() == line_120 + "\n");
}

TEST_CASE("the line of a step reports cutbacks and non-convergence, and omits unknown values") {
  Told told(Verbosity::verbose);
  StepReport r = report(1, 0);
  r.solve.iterations = 1;
  r.contacts = 1;
  r.min_distance = r.min_gap = std::numeric_limits<double>::infinity();
  r.cutbacks = 2;
  r.converged = false;
  told.progress.step(r);
  CHECK(told.out.str() ==
        "step 1  t 0 s (0%)  1 iteration  1 contact  2 halvings  not converged\n");
}

TEST_CASE("progress shows the self-distance of an object if no other object is near") {
  Told told(Verbosity::verbose);
  StepReport r = report(1, 0);
  r.min_gap = std::numeric_limits<double>::infinity();
  told.progress.step(r);
  CHECK(told.out.str() == "step 1  t 0 s (0%)  4 iterations  310 contacts  self-distance 1e-05 m\n");
}

TEST_CASE("the remaining time is shown in suitable units") {
  Told told(Verbosity::verbose);
  told.now += 4;
  told.progress.step(report(1, 5));
  CHECK_THAT(told.out.str(), Catch::EndsWith("  4s left\n"));
  told.now += 7196;
  told.progress.step(report(2, 5));
  CHECK_THAT(told.out.str(), Catch::EndsWith("  2h00m left\n"));
}

TEST_CASE("without a terminal a run prints at most twenty lines, and the log has all") {
  Told told(Verbosity::normal);
  for (int step = 1; step <= 1000; ++step) told.progress.step(report(step, step * 0.01));
  const std::string out = told.out.str();
  CHECK(std::count(out.begin(), out.end(), '\n') == 20);
  CHECK_THAT(out, Catch::StartsWith("step 50 "));
  CHECK_THAT(out, Catch::Contains("step 1000  t 10 s (100%)"));
  CHECK(out.find('\r') == std::string::npos);
  const std::string log = told.log.str();
  CHECK(std::count(log.begin(), log.end(), '\n') == 1000);
}

TEST_CASE("verbosity controls the terminal and not the log") {
  for (const Verbosity v : {Verbosity::quiet, Verbosity::normal, Verbosity::verbose}) {
    Told told(v);
    told.progress.message("m");
    told.progress.detail("d");
    told.progress.warning("w");
    CHECK(told.log.str() == "m\nd\nwarning: w\n");
    const std::string expected = v == Verbosity::quiet    ? "warning: w\n"
                                 : v == Verbosity::normal ? "m\nwarning: w\n"
                                                          : "m\nd\nwarning: w\n";
    CHECK(told.out.str() == expected);
  }
}

TEST_CASE("a quiet run shows no steps") {
  Told told(Verbosity::quiet, 80);
  told.progress.step(report(120, 4));
  told.progress.finish();
  CHECK(told.out.str() == "");
  CHECK_FALSE(told.log.str().empty());
}

TEST_CASE("the live line is rewritten at most ten times a second") {
  Told told(Verbosity::normal, 120);
  told.now += 60;
  told.progress.step(report(120, 4));
  CHECK(told.out.str() == "\r" + line_120 + "\x1b[K");
  told.now += 0.05;
  told.progress.step(report(121, 4.1));
  CHECK(told.out.str() == "\r" + line_120 + "\x1b[K");
  told.now += 0.06;
  told.progress.step(report(122, 4.2));
  CHECK_THAT(told.out.str(), Catch::Contains("\rstep 122  "));
  CHECK(told.log.str().find('\r') == std::string::npos);
}

TEST_CASE("messages and the end erase the live line") {
  Told told(Verbosity::normal, 120);
  told.now += 60;
  told.progress.step(report(120, 4));
  const std::string shown = "\r" + line_120 + "\x1b[K";
  told.progress.warning("thin ice");
  CHECK(told.out.str() == shown + "\r\x1b[Kwarning: thin ice\n");
  told.progress.step(report(120, 4));  // shown again at once
  CHECK(told.out.str() == shown + "\r\x1b[Kwarning: thin ice\n" + shown);
  told.progress.finish();
  told.progress.finish();
  CHECK(told.out.str() == shown + "\r\x1b[Kwarning: thin ice\n" + shown + "\r\x1b[K");
}

TEST_CASE("the live line never wraps") {
  Told told(Verbosity::normal, 21);
  told.now += 60;
  told.progress.step(report(120, 4));
  CHECK(told.out.str() == "\r" + line_120.substr(0, 20) + "\x1b[K");
}

TEST_CASE("a long step shows an iteration after every five seconds without output") {
  const std::string line = "step 8  t 4 s (40%)  iteration 31  residual 12.5";
  for (const Verbosity v : {Verbosity::quiet, Verbosity::normal, Verbosity::verbose}) {
    Told told(v);
    told.now += 4.9;
    told.progress.iteration(8, 4, 30, 20);
    CHECK(told.log.str() == "");
    told.now += 0.2;
    told.progress.iteration(8, 4, 31, 12.5);
    told.progress.iteration(8, 4, 32, 12);
    CHECK(told.log.str() == line + "\n");
    CHECK(told.out.str() == (v == Verbosity::quiet ? "" : line + "\n"));
    told.now += 4;
    told.progress.message("m");  // no silence
    told.now += 4;
    told.progress.iteration(8, 4, 40, 9);
    CHECK(told.log.str() == line + "\nm\n");
  }
}

TEST_CASE("on a terminal an iteration is shown in the live line") {
  Told told(Verbosity::normal, 120);
  told.now += 6;
  told.progress.iteration(8, 4, 31, 12.5);
  CHECK(told.out.str() == "\rstep 8  t 4 s (40%)  iteration 31  residual 12.5\x1b[K");
}

TEST_CASE("runs without a log and of zero duration work") {
  std::ostringstream out;
  Progress progress(out, nullptr);
  progress.begin(1, 1);
  progress.step(report(1, 1));
  CHECK_THAT(out.str(), Catch::Contains("(100%)"));
}

TEST_CASE("a pipe is no terminal") { CHECK(terminal_width(-1) == 0); }
