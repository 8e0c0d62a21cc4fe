// Base of probes of an interaction, by its term of class TermOf.
#pragma once

#include <string>

#include "framework/output/probe.hpp"
#include "framework/world/acting_interaction.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Returns the interaction of that name. Throws InputError with the nearest name if there is none.
const ActingInteraction& interaction_named(const World& world, const std::string& name,
                                           const std::string& probe);
// Throws InputError for an interaction of another type than that of the probe.
[[noreturn]] void refuse_interaction_type(const ActingInteraction& interaction,
                                          const std::string& probe, std::string_view type);

// Base: Probe or VectorProbe.
template <class TermOf, class Base>
class InteractionProbe : public Base {
 public:
  void fields(Fields& f) override {
    Base::fields(f);
    f.text("interaction", interaction_, "name of the interaction").required();
  }
  void prepare(const World& world) override {
    const ActingInteraction& interaction = interaction_named(world, interaction_, this->name_);
    term_ = nullptr;
    for (const Term* term : interaction.terms)
      if (const auto* found = dynamic_cast<const TermOf*>(term)) term_ = found;
    if (!term_) refuse_interaction_type(interaction, this->name_, this->type());
  }

 protected:
  const TermOf& term() const { return *term_; }

 private:
  const TermOf* term_ = nullptr;
  std::string interaction_;
};

}  // namespace tack
