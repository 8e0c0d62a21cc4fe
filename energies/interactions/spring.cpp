// Springs between vertices of two objects, and their probes.
#include <fmt/format.h>

#include <optional>

#include "energies/interactions/nearest_ends.hpp"
#include "energies/interactions/spring_term.hpp"
#include "framework/probes/interaction_probe.hpp"
#include "framework/setup/interaction_builder.hpp"

namespace tack {
namespace {

class Spring : public Interaction {
 public:
  void fields(Fields& f) override {
    Interaction::fields(f);
    f.object("from", from_, "vertices with one spring each");
    f.object("to", to_, "vertices: each spring ends at the one nearest at the start");
    f.number("stiffness", stiffness_, units::stiffness, "stiffness of each spring").required().positive();
    f.optional_number("length", length_, units::length, "rest length; the length at the start unless given")
        .nonnegative();
    f.optional_number("breaking_force", breaking_force_, units::force,
                      "force above which a spring breaks, checked at the end of each step; none breaks unless given")
        .positive();
  }
  std::vector<std::string> objects() const override { return {from_.object, to_.object}; }

  void build(InteractionBuilder& builder) const override {
    const std::vector<int> from = builder.vertices(from_), to = builder.vertices(to_);
    const VecX& rest = builder.rest();
    auto term = std::make_unique<SpringTerm>(builder.add_history("broken", 1, static_cast<int>(from.size())));
    for (const Edge& ends : nearest_ends(from, to, rest, fmt::format("spring '{}'", builder.name()))) {
      SpringTerm::Spring spring{stiffness_, length_.value_or(length_of(ends, rest))};
      if (breaking_force_) spring.strength = *breaking_force_;
      term->add(ends, spring);
    }
    builder.add(std::move(term));
  }

 private:
  ObjectVertices from_, to_;
  double stiffness_ = 1;                  // N/m
  std::optional<double> length_;          // m
  std::optional<double> breaking_force_;  // N
};

class SpringForce : public InteractionProbe<SpringTerm, VectorProbe> {
 public:
  Unit unit() const override { return units::force; }

 protected:
  Vec3 value(const World&, const State& state) override { return term().force(state.x); }
};

class IntactSprings : public InteractionProbe<SpringTerm, Probe> {
 public:
  Unit unit() const override { return units::none; }
  std::vector<double> sample(const World&, const State&) override { return {static_cast<double>(term().intact())}; }
};

TACK_REGISTER(Interaction, Spring, "spring", "Springs from each vertex of a selection to the nearest vertex of another selection; they may break.", "");
TACK_REGISTER(Probe, SpringForce, "spring_force", "Total force of springs on their start vertices [N].", "");
TACK_REGISTER(Probe, IntactSprings, "intact_springs", "Number of springs that are not broken.", "");

}  // namespace
}  // namespace tack
