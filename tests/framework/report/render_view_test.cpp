#include "framework/report/render_view.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"

using namespace tack;

TEST_CASE("looks go from the most general pattern to whole names, whatever their letters", "[report]") {
  RenderView view;
  bind(parse_string("objects: {'chip 1': {colour: '#ff0000'}, '*': {smooth: 50 deg}, 'chip*': {colour: '#00ff00', smooth: 60 deg}, 'c*': {smooth: 10 deg}}", "view.yaml"), view, "the view");
  std::vector<std::string> names;
  for (const auto& [name, look] : json_of(view, {48, 128})["objects"].items()) names.push_back(name);
  CHECK(names == std::vector<std::string>{"*", "c*", "chip*", "chip 1"});
}
