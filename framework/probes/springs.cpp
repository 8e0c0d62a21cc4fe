// Probes of springs.
#include <fmt/format.h>

#include "framework/config/nearest.hpp"
#include "framework/output/probe.hpp"
#include "framework/scene/spring_term.hpp"
#include "framework/scene/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

const SpringTerm& springs_named(const World& world, const std::string& springs, const std::string& probe) {
  std::vector<std::string> names;
  for (const SpringTerm* term : world.springs) {
    if (term->label() == springs) return *term;
    names.push_back(term->label());
  }
  throw InputError(fmt::format("probe '{}': no springs are named '{}'{}", probe, springs, suggestion(springs, names, "springs")));
}

template <class Base>
class OfSprings : public Base {
 public:
  void fields(Fields& f) override {
    Base::fields(f);
    f.text("springs", springs_, "their name").required();
  }
  void prepare(const World& world) override { term_ = &springs_named(world, springs_, this->name_); }

 protected:
  const SpringTerm* term_ = nullptr;

 private:
  std::string springs_;
};

class SpringForce : public OfSprings<VectorProbe> {
 public:
  Unit unit() const override { return units::force; }

 protected:
  Vec3 value(const World&, const State& state) override { return term_->force(state.x); }
};

class IntactSprings : public OfSprings<Probe> {
 public:
  Unit unit() const override { return units::none; }
  std::vector<double> sample(const World&, const State&) override { return {static_cast<double>(term_->intact())}; }
};

TACK_REGISTER(Probe, SpringForce, "spring_force", "What springs exert on the vertices that they start from, in sum [N].", "");
TACK_REGISTER(Probe, IntactSprings, "intact_springs", "How many springs are not broken.", "");

}  // namespace
}  // namespace tack
