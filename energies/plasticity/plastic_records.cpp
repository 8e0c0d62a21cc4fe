#include "energies/plasticity/plastic_records.hpp"

#include "framework/core/published_field.hpp"

namespace tack {
namespace {

class PlasticStrain : public PublishedField {
  bool of_elements() const override { return true; }
};
TACK_REGISTER(PublishedField, PlasticStrain, "plastic_strain", "Accumulated.", "");

}  // namespace

void publish_plasticity(Records& records, const std::string& term, std::function<double(const VecX& x)> work,
                        const std::vector<double>& strain) {
  publish_plasticity(records, term, std::move(work), [&strain] { return VecX(Eigen::Map<const VecX>(strain.data(), static_cast<Eigen::Index>(strain.size()))); },
                     nullptr);
}

void publish_plasticity(Records& records, const std::string& term, std::function<double(const VecX& x)> work,
                        std::function<VecX()> strain, const std::vector<Tet>* tets) {
  records.add(FlowRecord{term, {{"dissipated_plastic"}}, [work = std::move(work)](const VecX& x, double* amounts) { amounts[0] = work(x); }});
  FieldRecord field{"plastic_strain", [strain = std::move(strain)](const VecX&) { return strain(); }};
  field.of_elements = true;
  field.tets = tets;
  records.add(std::move(field));
}

}  // namespace tack
