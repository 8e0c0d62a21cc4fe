// Maxwell branch of a sheet in plane stress (maxwell.hpp): the spring stores
// mu |e|^2 + lambda/2 (tr e)^2 in the Hencky strain e of the sheet's plane, lambda = 2 mu nu / (1 - nu),
// and all of e decays, so that the thickness follows as the sheet is incompressible (nu = 0.5) or not.
#include "energies/shell/membrane.hpp"
#include "energies/viscoelastic/branch_parameters.hpp"
#include "energies/viscoelastic/relaxing_term.hpp"

namespace tack {
namespace {

struct MaxwellSheet {
  double mu, lambda;  // Pa

  Pack energy(const PlaneStrain&, const PackMat32& f) const {
    const PackVec2 s = plane_stretch(f).s;
    const Pack e0 = log(s(0)), e1 = log(s(1)), trace = e0 + e1;
    return select(s.prod() > 0, mu * (e0 * e0 + e1 * e1) + lambda / 2 * trace * trace, std::numeric_limits<double>::infinity());
  }
  PlaneDerivatives derivatives(const PackVec2& s) const {
    const PackVec2 e(log(s(0)), log(s(1)));
    PackVec2 tau;
    for (int i = 0; i < 2; ++i) tau(i) = 2 * mu * e(i) + lambda * (e(0) + e(1));
    PackMat2 h = PackMat2::Constant(lambda);
    for (int i = 0; i < 2; ++i) h(i, i) = 2 * mu + lambda;
    return of_logarithms(s, tau, h);
  }
};

class MaxwellSheetTerm : public RelaxingTerm<MaxwellSheetTerm, MembraneTerm<MaxwellSheet>, 2> {
 public:
  MaxwellSheetTerm(std::string name, const Relaxation<2>& relaxation, const TemperatureShift& shift, const Body& body, const VecX& rest)
      : RelaxingTerm(ViscousHistory<2>(body, relaxation), ShiftedTimes(shift, body, body.sheet, rest), std::move(name), MaxwellSheet{relaxation.mu, relaxation.lambda},
                     body, rest),
        rest_shapes_(rest_) {
    load_history({});
  }

 protected:
  StressRecord stress_record() const override {
    return StressRecord{[this](const VecX& x) { return per_deformed_volume(cauchy_stress(x)); }};
  }

 private:
  friend RelaxingTerm;
  void apply_history() {
    const Relaxation<2>& relaxation = history_.relaxation();
    material_ = {material_factor() * relaxation.mu, material_factor() * relaxation.lambda};
    for_each(static_cast<int>(rest_.size()), [&](int p) {
      for (int l = 0; l < pack_width; ++l) {
        const int t = std::min(p * pack_width + l, count() - 1);
        set_lane<2, 2>(rest_[p].shape, l, get_lane<2, 2>(rest_shapes_[p].shape, l) * history_.inverse(t));
        rest_[p].volume.set(l, volume_of(t) * volume_factor(t));
      }
    }, chunk_size / pack_width);
  }
  int samples() const { return count(); }
  Strain strain(int t, const VecX& x) const {
    const Mat32 f = deformation_gradient(rest_of(t), triangles_[t], x);
    PackMat32 same;
    for (int i = 0; i < 6; ++i) same(i) = f(i);
    const PlaneStretch stretch = plane_stretch(same);
    return history_.relaxation().strain(get_lane<2, 2>(stretch.v, 0), get_lane<2, 1>(stretch.s, 0));
  }
  double volume_of(int t) const { return rest_shapes_[t / pack_width].volume[t % pack_width]; }

  std::vector<SheetRest<Pack>> rest_shapes_;  // without viscous flow; rest_ includes it
};

class MaxwellMembrane : public Energy {
 public:
  void fields(Fields& f) override {
    Energy::fields(f);
    branch_.stiffness_fields(f);
    f.number("poisson", poisson_, units::none, "Poisson's ratio of the spring; 0.5: its volume does not change").range(0, 0.5);
    branch_.time_fields(f);
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    require_sheet(body, rest, type());
    const double shear = branch_.shear(body, type());
    return std::make_unique<MaxwellSheetTerm>(std::string(type()), Relaxation<2>{shear, 2 * shear * poisson_ / (1 - poisson_), branch_.time, false}, branch_.shift, body,
                                              rest);
  }
  bool depends_on_temperature() const override { return branch_.shift.shifts(); }

 private:
  BranchParameters branch_;
  double poisson_ = 0.5;
};

TACK_REGISTER(Energy, MaxwellMembrane, "maxwell_membrane",
              "Spring and dashpot in series, beside the membrane of a sheet: relaxation in its plane. Without mass. Several make a Prony series.",
              "Simo 1987; Reese and Govindjee 1998");

}  // namespace
}  // namespace tack
