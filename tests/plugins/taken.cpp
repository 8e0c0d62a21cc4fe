// A plugin with a name that is free and one that is taken.
#include "framework/config/field.hpp"
#include "framework/output/probe.hpp"

namespace {

struct Constant : tack::Probe {
  tack::Unit unit() const override { return tack::units::none; }
  void prepare(const tack::World&) override {}
  std::vector<double> sample(const tack::World&, const tack::State&) override { return {1}; }
};
struct Other : Constant {};

TACK_REGISTER(tack::Probe, Constant, "constant", "One.", "");
TACK_REGISTER(tack::Probe, Other, "gap", "Another gap.", "");

}  // namespace
