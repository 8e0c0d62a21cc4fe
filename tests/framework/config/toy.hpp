// A small tree of configurable things with every kind of field; its components are registered in
// registry_test.cpp.
#pragma once

#include <functional>
#include <string>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "geometry/errors.hpp"

namespace tack::toy {

struct Energy : Component {
  static constexpr const char* kind_name = "toy_energy";
  static constexpr const char* kind_doc = "Energy of the tests.";
  virtual double value() const = 0;
};

struct Spring : Energy {
  double stiffness = 2;  // N/m
  double rest = 0.25;    // m
  double range = 1;      // m
  double value() const override { return 0.5 * stiffness * rest * rest; }
  void fields(Fields& f) override {
    f.number("stiffness", stiffness, units::stiffness, "force per elongation").positive();
    f.number("rest", rest, units::length, "length without force").nonnegative();
    f.number("range", range, units::length, "largest length").positive();
    f.check("rest", [this]() -> std::string {
      return rest < range ? "" : "must be smaller than range; raise range or lower it";
    });
  }
};

struct Solid : Energy {
  double young = 0;    // Pa
  double density = 0;  // kg/m^3
  double value() const override { return young; }
  void fields(Fields& f) override {
    f.number("young", young, units::pressure, "Young's modulus").required().positive();
    f.number("density", density, units::density, "mass per volume").positive().required();
  }
};

struct Nothing : Energy {
  double value() const override { return 0; }
};

struct Sum : Energy {
  std::vector<std::unique_ptr<Energy>> terms;
  double value() const override {
    double sum = 0;
    for (const auto& term : terms) sum += term->value();
    return sum;
  }
  void fields(Fields& f) override { f.component_list("terms", terms, "what is added"); }
};

enum class Form { plain, squared };

struct Time {
  double step = 0.01;  // s
  int steps = 10;
  void fields(Fields& f) {
    f.number("step", step, units::time, "time step").positive();
    f.integer("steps", steps, "number of steps").at_least(1);
  }
};

struct Object {
  std::string name;
  Vec3 size = Vec3(1, 2, 3);  // m
  void fields(Fields& f) {
    f.text("name", name, "how others refer to it").required();
    f.vector("size", size, units::length, "edge lengths").positive();
  }
};

struct Scene {
  double density = 1000;
  std::optional<double> young;
  int count = 3;
  std::optional<int> seed;
  bool verbose = false;
  std::string title = "toy";
  std::string mesh;
  Vec3 gravity = Vec3(0, -9.81, 0);
  Vec2 extent = Vec2(1, 1);
  std::array<int, 3> cells{1, 2, 3};
  std::array<int, 2> grid{4, 5};
  std::optional<Vec3> target;
  std::vector<double> angles{0.5};
  std::vector<std::string> tags{"a", "b"};
  Form form = Form::plain;
  Time time;
  std::optional<Time> ramp;
  std::vector<Object> objects;
  std::map<std::string, Time> clocks;
  std::unique_ptr<Energy> energy;
  std::shared_ptr<Energy> spring = std::make_shared<Spring>();
  std::vector<std::unique_ptr<Energy>> energies;
  Schedule pull;
  Value later;

  void fields(Fields& f) {
    f.number("density", density, units::density, "mass per volume").positive();
    f.optional_number("young", young, units::pressure, "stiffness").positive();
    f.integer("count", count, "how many").range(0, 10);
    f.optional_integer("seed", seed, "start of the random numbers");
    f.flag("verbose", verbose, "whether to say more");
    f.text("title", title, "what to call it");
    f.path("mesh", mesh, "a file");
    f.vector("gravity", gravity, units::acceleration, "acceleration of free fall");
    f.vector("extent", extent, units::length, "width and height");
    f.vector("cells", cells, "cells along each axis").at_least(1);
    f.vector("grid", grid, "cells of the grid");
    f.optional_vector("target", target, units::length, "where to go");
    f.numbers("angles", angles, units::angle, "some angles").nonempty();
    f.texts("tags", tags, "some words");
    f.choice("form", form,
             {{"plain", Form::plain, "in the gap"}, {"squared", Form::squared, "in its square"}},
             "argument of the law");
    f.object("time", time, "when");
    f.optional_object("ramp", ramp, "when else");
    f.list("objects", objects, "what");
    f.map("clocks", clocks, "named times");
    f.component("energy", energy, "the energy");
    f.component("spring", spring, "an energy with a default");
    f.component_list("energies", energies, "more energies");
    f.schedule("pull", pull, units::length, "displacement over time");
    f.raw("later", later, "kept as it is");
  }
};

inline Scene bound(const std::string& yaml) {
  Scene scene;
  bind(parse_string(yaml, "s.yaml"), scene, "scene");
  return scene;
}

// The message of the InputError that `action` throws; "" without one.
inline std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

inline std::string bind_error(const std::string& yaml) {
  return message_of([&] { bound(yaml); });
}

}  // namespace tack::toy
