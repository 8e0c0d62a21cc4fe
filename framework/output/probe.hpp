// A quantity recorded every step: one or more columns of probes.csv, which `expect` refers to.
#pragma once

#include <string>
#include <vector>

#include "framework/config/field.hpp"

namespace tack {

struct World;
struct State;

/// Base of probes: prepare() once per world, then sample() after each step.
class Probe : public Component {
 public:
  static constexpr const char* kind_name = "probe";
  static constexpr const char* kind_doc = "A quantity recorded every step.";

  void fields(Fields& f) override {
    f.text("name", name_, "column in probes.csv").required().line();
  }
  const std::string& name() const { return name_; }

  /// Checks the probe against the world and finds its vertices. Throws InputError.
  virtual void prepare(const World& world) = 0;
  virtual std::vector<std::string> columns() const { return {name_}; }
  /// Returns the unit of all its columns. It must follow from the keys alone.
  virtual Unit unit() const = 0;
  /// Returns true if infinity is a valid value, such as the gap of objects out of range.
  virtual bool unbounded() const { return false; }
  /// Returns true if the probe needs the energy balance of the steps, which costs time.
  virtual bool needs_dissipation() const { return false; }
  /// Returns one value per column, at an accepted state.
  virtual std::vector<double> sample(const World& world, const State& state) = 0;

 protected:
  std::string name_;
};

/// A probe of a vector: its component along a direction, if given (one column), else x, y and z.
class VectorProbe : public Probe {
 public:
  void fields(Fields& f) override;
  std::vector<std::string> columns() const override;
  std::vector<double> sample(const World& world, const State& state) override;

 protected:
  virtual Vec3 value(const World& world, const State& state) = 0;

 private:
  std::optional<Vec3> direction_;
};

}  // namespace tack
