#include "framework/config/schedule.hpp"

#include <catch2/catch.hpp>

#include "tests/framework/config/toy.hpp"

using namespace tack;

TEST_CASE("a schedule is linear between its points and constant outside") {
  const Schedule s({{1, 10}, {2, 20}, {4, 0}});
  CHECK(s.at(0) == 10);
  CHECK(s.at(1) == 10);
  CHECK(s.at(1.25) == 12.5);
  CHECK(s.at(2) == 20);
  CHECK(s.at(3) == 10);
  CHECK(s.at(4) == 0);
  CHECK(s.at(9) == 0);
  CHECK(Schedule(3).at(7) == 3);
  CHECK(Schedule(3).constant());
}

TEST_CASE("a schedule needs increasing times") {
  CHECK(toy::message_of([] { Schedule(std::vector<Schedule::Point>{}); }) ==
        "a schedule needs at least one [time, value] pair");
  CHECK(toy::message_of([] {
          Schedule({{0, 1}, {0, 2}});
        }) == "the times of a schedule must increase, but 0 s follows 0 s");
}

TEST_CASE("a schedule is read with units") {
  CHECK(toy::bound("pull: 3 mm\n").pull == Schedule(0.003));
  CHECK(toy::bound("pull: [[0, 0], [500 ms, 2 cm]]\n").pull == Schedule({{0, 0}, {0.5, 0.02}}));
  CHECK(toy::bind_error("pull: [[0, 0], [1 mm, 1]]\n") ==
        "s.yaml:1:17: pull: expects a time (s), got '1 mm', which is a length");
  CHECK(toy::bind_error("pull: [[0, 0], 3]\n") ==
        "s.yaml:1:16: pull: expects [time, length] pairs, got '3'");
  CHECK(toy::bind_error("pull: [[1, 0], [0, 1]]\n") ==
        "s.yaml:1:7: pull: the times of a schedule must increase, but 0 s follows 1 s");
  CHECK(toy::bind_error("pull: []\n") ==
        "s.yaml:1:7: pull: a schedule needs at least one [time, value] pair");
  CHECK(toy::bind_error("pull: {a: 1}\n") ==
        "s.yaml:1:7: pull: expects a length (m) or list of [time (s), length], got a map");
}
