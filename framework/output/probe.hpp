// A quantity recorded every step: one or more columns of probes.csv, which `expect` refers to.
#pragma once

#include <string>
#include <vector>

#include "framework/config/field.hpp"

namespace tack {

struct World;
struct State;

class Probe : public Component {
 public:
  static constexpr const char* kind_name = "probe";
  static constexpr const char* kind_doc = "A quantity recorded every step.";

  void fields(Fields& f) override { f.text("name", name_, "column in probes.csv").required().line(); }
  const std::string& name() const { return name_; }

  // Checks the probe against the world and finds its vertices; throws InputError.
  virtual void prepare(const World& world) = 0;
  virtual std::vector<std::string> columns() const { return {name_}; }
  // Of every column: what numbers that are compared with it may be written in. It follows from the keys alone.
  virtual Unit unit() const = 0;
  // Whether infinity is one of its values: a gap, of objects out of reach.
  virtual bool unbounded() const { return false; }
  // Whether it is of what was dissipated so far, an account that costs.
  virtual bool asks_for_losses() const { return false; }
  // One value per column, at an accepted state.
  virtual std::vector<double> sample(const World& world, const State& state) = 0;

 protected:
  std::string name_;
};

// A probe of a vector: its component along a direction if one is given (one column), else x, y and z.
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
