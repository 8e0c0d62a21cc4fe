// Records of the normal contact potential: forces, energies and contact points.
#include <cmath>

#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/terms/contact_term.hpp"

namespace tack {

void ContactTerm::publish(Records& records) const {
  ForceRecord force{"contact", ForceDirection::normal, {"barrier", "adhesion"}};
  force.add = [this](const VecX& x, std::string_view part, VecX& sum) { sum += forces(x, law_term(part)); };
  force.between = [this](const VecX& x, std::string_view part, ObjectPair pair) { return force_between(x, law_term(part), pair); };
  force.add_compressions = [this](const VecX& x, std::string_view part, VecX& pressed) { pressed += compressions(x, law_term(part)); };
  force.add_areas = [this](const VecX& x, VecX& areas) {
    for_each_record(contact_points({system_, integrated_laws(system_.pairs()), x}), [&](const auto& c) {
      for (size_t i = 0; i < c.vertices.size(); ++i) areas(3 * c.vertices[i]) += c.area * std::abs(c.coefficients[i]);
    });
  };
  records.add(std::move(force));
  for (const auto& [name, term] : {std::pair{"barrier", LawTerm::barrier}, {"adhesion", LawTerm::adhesion}})
    records.add(EnergyRecord{name, EnergyKind::contact, [this, term = term](const VecX& x) { return term_value(x, term); }});
}

}  // namespace tack
