#include "tests/framework/config/toy.hpp"

namespace tack::toy {

void Spring::fields(Fields& f) {
  f.number("stiffness", stiffness, units::stiffness, "force per elongation").positive();
  f.number("rest", rest, units::length, "length without force").nonnegative();
  f.number("range", range, units::length, "largest length").positive();
  f.check("rest", [this]() -> std::string {
    return rest < range ? "" : "must be smaller than range; raise range or lower it";
  });
}

void Solid::fields(Fields& f) {
  f.number("young", young, units::pressure, "Young's modulus").required().positive();
  f.number("density", density, units::density, "mass per volume").positive().required();
}

void Time::fields(Fields& f) {
  f.number("step", step, units::time, "time step").positive();
  f.integer("steps", steps, "number of steps").at_least(1);
}

void Object::fields(Fields& f) {
  f.text("name", name, "how others refer to it").required();
  f.vector("size", size, units::length, "edge lengths").positive();
}

void Scene::fields(Fields& f) {
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

Scene bound(const std::string& yaml) {
  Scene scene;
  bind(parse_string(yaml, "s.yaml"), scene, "scene");
  return scene;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

std::string bind_error(const std::string& yaml) {
  return message_of([&] { bound(yaml); });
}

}  // namespace tack::toy
