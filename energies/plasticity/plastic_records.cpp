#include "energies/plasticity/plastic_records.hpp"

#include "framework/core/published_field.hpp"

namespace tack {
namespace {

class PlasticStrain : public PublishedField {
  bool of_elements() const override { return true; }
};
TACK_REGISTER(PublishedField, PlasticStrain, "plastic_strain", "Accumulated equivalent plastic strain.", "");

}  // namespace

void publish_plasticity(Records& records, const std::string& term, PlasticFlows flows, const std::vector<double>& strain) {
  publish_plasticity(records, term, std::move(flows), [&strain] { return VecX(Eigen::Map<const VecX>(strain.data(), static_cast<Eigen::Index>(strain.size()))); },
                     nullptr);
}

void publish_plasticity(Records& records, const std::string& term, PlasticFlows flows, std::function<VecX()> strain,
                        const std::vector<Tet>* tets) {
  records.add(FlowRecord{term, {{"dissipated_plastic"}}, [work = std::move(flows.work)](const VecX& x, double* amounts) { amounts[0] = work(x); }});
  if (flows.viscous)
    records.add(FlowRecord{term, {{"dissipated_viscous"}}, [viscous = std::move(flows.viscous)](const VecX& x, double* amounts) { amounts[0] = viscous(x); }});
  FieldRecord field{"plastic_strain", [strain = std::move(strain)](const VecX&) { return strain(); }};
  field.of_elements = true;
  field.tets = tets;
  records.add(std::move(field));
}

}  // namespace tack
