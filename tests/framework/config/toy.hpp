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
  void fields(Fields& f) override;
};

struct Solid : Energy {
  double young = 0;    // Pa
  double density = 0;  // kg/m^3
  double value() const override { return young; }
  void fields(Fields& f) override;
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
  void fields(Fields& f);
};

struct Object {
  std::string name;
  Vec3 size = Vec3(1, 2, 3);  // m
  void fields(Fields& f);
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

  void fields(Fields& f);
};

Scene bound(const std::string& yaml);

// The message of the InputError that `action` throws; "" without one.
std::string message_of(const std::function<void()>& action);

std::string bind_error(const std::string& yaml);

}  // namespace tack::toy
