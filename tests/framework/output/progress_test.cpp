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
  Told reported(Verbosity::verbose);
  reported.now += 60;
  reported.progress.step(report(120, 4));
  CHECK(reported.out.str() == line_120 + "\n");
  CHECK(reported.log.str() == line_120 + "\n");
}

TEST_CASE("the line of a step reports cutbacks and non-convergence, and omits unknown values") {
  Told reported(Verbosity::verbose);
  StepReport r = report(1, 0);
  r.solve.iterations = 1;
  r.contacts = 1;
  r.min_distance = r.min_gap = std::numeric_limits<double>::infinity();
  r.rejections[Rejection::solve] = 2;
  r.converged = false;
  reported.progress.step(r);
  CHECK(reported.out.str() ==
        "step 1  t 0 s (0%)  1 iteration  1 contact  2 halvings  not converged\n");
}

TEST_CASE("progress shows the self-distance of an object if no other object is near") {
  Told reported(Verbosity::verbose);
  StepReport r = report(1, 0);
  r.min_gap = std::numeric_limits<double>::infinity();
  reported.progress.step(r);
  CHECK(reported.out.str() == "step 1  t 0 s (0%)  4 iterations  310 contacts  self-distance 1e-05 m\n");
}

TEST_CASE("the remaining time of a run that its protocols may end is a limit") {
  Told reported(Verbosity::verbose);
  reported.progress.begin(0, 10, true);
  reported.now += 60;
  reported.progress.step(report(120, 4));
  CHECK_THAT(reported.out.str(), Catch::EndsWith("  at most 1m30s left\n"));
}

TEST_CASE("the remaining time is shown in suitable units") {
  Told reported(Verbosity::verbose);
  reported.now += 4;
  reported.progress.step(report(1, 5));
  CHECK_THAT(reported.out.str(), Catch::EndsWith("  4s left\n"));
  reported.now += 7196;
  reported.progress.step(report(2, 5));
  CHECK_THAT(reported.out.str(), Catch::EndsWith("  2h00m left\n"));
}

TEST_CASE("without a terminal a run prints at most twenty lines, and the log has all") {
  Told reported(Verbosity::normal);
  for (int step = 1; step <= 1000; ++step) reported.progress.step(report(step, step * 0.01));
  const std::string out = reported.out.str();
  CHECK(std::count(out.begin(), out.end(), '\n') == 20);
  CHECK_THAT(out, Catch::StartsWith("step 50 "));
  CHECK_THAT(out, Catch::Contains("step 1000  t 10 s (100%)"));
  CHECK(out.find('\r') == std::string::npos);
  const std::string log = reported.log.str();
  CHECK(std::count(log.begin(), log.end(), '\n') == 1000);
}

TEST_CASE("verbosity controls the terminal and not the log") {
  for (const Verbosity v : {Verbosity::quiet, Verbosity::normal, Verbosity::verbose}) {
    Told reported(v);
    reported.progress.message("m");
    reported.progress.detail("d");
    reported.progress.warning("w");
    CHECK(reported.log.str() == "m\nd\nwarning: w\n");
    const std::string expected = v == Verbosity::quiet    ? "warning: w\n"
                                 : v == Verbosity::normal ? "m\nwarning: w\n"
                                                          : "m\nd\nwarning: w\n";
    CHECK(reported.out.str() == expected);
  }
}

TEST_CASE("a quiet run shows no steps") {
  Told reported(Verbosity::quiet, 80);
  reported.progress.step(report(120, 4));
  reported.progress.finish();
  CHECK(reported.out.str() == "");
  CHECK_FALSE(reported.log.str().empty());
}

TEST_CASE("the live line is rewritten at most ten times a second") {
  Told reported(Verbosity::normal, 120);
  reported.now += 60;
  reported.progress.step(report(120, 4));
  CHECK(reported.out.str() == "\r" + line_120 + "\x1b[K");
  reported.now += 0.05;
  reported.progress.step(report(121, 4.1));
  CHECK(reported.out.str() == "\r" + line_120 + "\x1b[K");
  reported.now += 0.06;
  reported.progress.step(report(122, 4.2));
  CHECK_THAT(reported.out.str(), Catch::Contains("\rstep 122  "));
  CHECK(reported.log.str().find('\r') == std::string::npos);
}

TEST_CASE("messages and the end erase the live line") {
  Told reported(Verbosity::normal, 120);
  reported.now += 60;
  reported.progress.step(report(120, 4));
  const std::string shown = "\r" + line_120 + "\x1b[K";
  reported.progress.warning("thin ice");
  CHECK(reported.out.str() == shown + "\r\x1b[Kwarning: thin ice\n");
  reported.progress.step(report(120, 4));  // shown again at once
  CHECK(reported.out.str() == shown + "\r\x1b[Kwarning: thin ice\n" + shown);
  reported.progress.finish();
  reported.progress.finish();
  CHECK(reported.out.str() == shown + "\r\x1b[Kwarning: thin ice\n" + shown + "\r\x1b[K");
}

TEST_CASE("the live line never wraps") {
  Told reported(Verbosity::normal, 21);
  reported.now += 60;
  reported.progress.step(report(120, 4));
  CHECK(reported.out.str() == "\r" + line_120.substr(0, 20) + "\x1b[K");
}

TEST_CASE("a long step shows an iteration after every five seconds without output") {
  const std::string line = "step 8  t 4 s (40%)  iteration 31  residual 12.5";
  for (const Verbosity v : {Verbosity::quiet, Verbosity::normal, Verbosity::verbose}) {
    Told reported(v);
    reported.now += 4.9;
    reported.progress.iteration(8, 4, 30, 20);
    CHECK(reported.log.str() == "");
    reported.now += 0.2;
    reported.progress.iteration(8, 4, 31, 12.5);
    reported.progress.iteration(8, 4, 32, 12);
    CHECK(reported.log.str() == line + "\n");
    CHECK(reported.out.str() == (v == Verbosity::quiet ? "" : line + "\n"));
    reported.now += 4;
    reported.progress.message("m");  // no silence
    reported.now += 4;
    reported.progress.iteration(8, 4, 40, 9);
    CHECK(reported.log.str() == line + "\nm\n");
  }
}

TEST_CASE("on a terminal an iteration is shown in the live line") {
  Told reported(Verbosity::normal, 120);
  reported.now += 6;
  reported.progress.iteration(8, 4, 31, 12.5);
  CHECK(reported.out.str() == "\rstep 8  t 4 s (40%)  iteration 31  residual 12.5\x1b[K");
}

TEST_CASE("runs without a log and of zero duration work") {
  std::ostringstream out;
  Progress progress(out, nullptr);
  progress.begin(1, 1);
  progress.step(report(1, 1));
  CHECK_THAT(out.str(), Catch::Contains("(100%)"));
}

TEST_CASE("a pipe is no terminal") { CHECK(terminal_width(-1) == 0); }
