#include "framework/report/render_view.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "geometry/errors.hpp"

using namespace tack;

TEST_CASE("looks go from the most general pattern to whole names, whatever their letters", "[report]") {
  RenderView view;
  bind(parse_string("objects: {'chip 1': {colour: '#ff0000'}, '*': {smooth: 50 deg}, 'chip*': {colour: '#00ff00', smooth: 60 deg}, 'c*': {smooth: 10 deg}}", "view.yaml"), view, "the view");
  std::vector<std::string> names;
  const nlohmann::ordered_json json = json_of(view, {48, 128});
  for (const auto& [name, look] : json["objects"].items()) names.push_back(name);
  CHECK(names == std::vector<std::string>{"*", "c*", "chip*", "chip 1"});
}

TEST_CASE("a film has a picture of each frame between its times", "[report]") {
  const std::vector<double> frames{0, 0.1, 0.2, 0.1 + 0.2, 1, 5};  // unevenly spaced; 0.1 + 0.2 is above 0.3
  RenderView view;
  CHECK(film_times(view, frames) == frames);
  view.from = 0.1;
  view.to = 0.3;
  view.fps = 7;
  CHECK(film_times(view, frames) == std::vector<double>{0.1, 0.2, 0.1 + 0.2});
  view.to = 0.1;
  CHECK(film_times(view, frames) == std::vector<double>{0.1});
}

TEST_CASE("a film with a speed has evenly spaced pictures", "[report]") {
  RenderView view;
  view.speed = 0.5;
  view.fps = 2;
  CHECK(film_times(view, {0, 0.1, 1}) == std::vector<double>{0, 0.25, 0.5, 0.75, 1});
  view.from = 0.5;
  view.to = 0.5;
  CHECK(film_times(view, {0, 0.1, 1}) == std::vector<double>{0.5, 0.5});
  view.to = 1;
  view.speed = 1e-9;
  CHECK_THROWS_WITH(film_times(view, {0, 0.1, 1}), Catch::Contains("speed: 1e-09 makes a film of 1e+09 pictures"));
}

TEST_CASE("a film without frames is refused with the times of the run", "[report]") {
  RenderView view;
  const auto refused = [&](double from, double to) {
    view.from = from;
    view.to = to;
    CHECK_THROWS_WITH(film_times(view, {0, 1, 5}), Catch::Contains("the frames of the run go from 0 to 5 s") && Catch::Contains("choose other times"));
  };
  for (const bool evenly : {false, true}) {
    if (evenly) view.speed = 1;
    refused(10, 20);
    refused(-2, -1);
    refused(4, 1);
  }
  view.speed.reset();
  refused(1.1, 1.2);
  view.to.reset();
  view.from = 10;
  CHECK_THROWS_WITH(film_times(view, {0, 1, 5}), Catch::Contains("no frame is between 10 and 5 s (from, to)"));
}
