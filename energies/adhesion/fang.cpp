// Fang normal adhesion (the paper, eq. 10-12): a traction that rises to Y eps_c at dhat_p and falls to
// zero at dhat_a. plain: piecewise quadratic in d, the traction a triangle, work Y eps_c dhat_a / 2.
// squared: the same polynomial in s = d^2, traction at dhat_p still Y eps_c.
#include <fmt/format.h>

#include <cmath>

#include "framework/config/field.hpp"
#include "framework/contact/normal_law.hpp"
#include "geometry/errors.hpp"

namespace tack {

class FangAdhesion : public NormalLawOf<FangAdhesion, NormalAdhesion> {
 public:
  enum class Form { plain, squared };

  void fields(Fields& f) override {
    f.choice("form", form_, {{"plain", Form::plain, "polynomial in the gap"},
                             {"squared", Form::squared, "polynomial in the squared gap"}},
             "the argument of the law");
    f.optional_number("young", young_, units::pressure,
                      "Y; the smaller Young's modulus of the pair unless given").positive();
    f.optional_number("critical_strain", critical_strain_, units::none,
                      "eps_c: detaches at the stress Y eps_c").positive();
    f.optional_number("peak_traction", given_peak_, units::pressure,
                      "the strength, instead of critical_strain").positive();
    f.optional_number("work_of_adhesion", given_work_, units::work_of_adhesion,
                      "energy to separate unit area; sets range, with peak_traction").positive();
    f.optional_number("peak_distance", given_peak_distance_, units::length,
                      "dhat_p: gap of the largest traction; the contact distance unless given").positive();
    f.optional_number("range", given_range_, units::length,
                      "dhat_a: gap beyond which nothing adheres; twice peak_distance unless given").positive();
    f.check("critical_strain", [this]() -> std::string {
      if (critical_strain_.has_value() != given_peak_.has_value()) return "";
      return "give the strength either as critical_strain or as peak_traction";
    });
    f.check("work_of_adhesion", [this]() -> std::string {
      if (!given_work_) return "";
      if (!given_peak_) return "goes with peak_traction: add it, or drop work_of_adhesion";
      return given_range_ ? "already fixes the range: drop range" : "";
    });
    f.check("range", [this]() -> std::string {
      if (!given_range_ || !given_peak_distance_ || *given_range_ > *given_peak_distance_) return "";
      return "must be larger than peak_distance: raise range or lower peak_distance";
    });
  }

  void prepare(const PairMaterials& m) override;
  double range() const override { return dhat_a_; }
  double peak_traction() const override;
  double work_of_adhesion() const override { return -energy(0.0); }

  template <class T>
  T energy(const T& d) const {
    const T u = form_ == Form::plain ? d : d * d;
    if (u < T(p_)) return T(a1_) * u * u + T(c1_);
    return T(a2_) * (u - T(end_)) * (u - T(end_));  // = a2 u^2 + b2 u + c2, without cancellation
  }

 private:
  double range_of_work(double peak, double work) const;
  void set_polynomial(double peak);

  Form form_ = Form::plain;
  std::optional<double> young_, critical_strain_, given_peak_, given_work_;
  std::optional<double> given_peak_distance_, given_range_;
  double dhat_p_ = 1e-3, dhat_a_ = 2e-3;  // m
  double p_ = 1e-3, end_ = 2e-3;          // in the law's argument [m or m^2]
  double a1_ = 0, a2_ = 0, c1_ = 0;
};

void FangAdhesion::prepare(const PairMaterials& m) {
  const double young = young_.value_or(m.softer_young);
  if (!given_peak_ && young <= 0)
    throw InputError("adhesion fang: neither side has a Young's modulus; give young or peak_traction");
  const double peak = given_peak_ ? *given_peak_ : young * critical_strain_.value_or(0.0);
  dhat_p_ = given_peak_distance_.value_or(m.contact_distance);
  dhat_a_ = given_work_ ? range_of_work(peak, *given_work_) : given_range_.value_or(2 * dhat_p_);
  if (dhat_p_ < m.contact_distance * (1 - 1e-12))
    throw InputError(fmt::format("adhesion fang: peak_distance {:.6g} m is below the contact distance {:.6g} m, "
                                 "where the barrier pushes; raise it or lower contact.distance",
                                 dhat_p_, m.contact_distance));
  if (!(dhat_a_ > dhat_p_))
    throw InputError(fmt::format("adhesion fang: range {:.6g} m must be larger than peak_distance {:.6g} m; raise "
                                 "range (or work_of_adhesion), or lower peak_distance", dhat_a_, dhat_p_));
  set_polynomial(peak);
}

void FangAdhesion::set_polynomial(double peak) {
  const bool plain = form_ == Form::plain;
  p_ = plain ? dhat_p_ : dhat_p_ * dhat_p_;
  end_ = plain ? dhat_a_ : dhat_a_ * dhat_a_;
  a2_ = plain ? peak / (2 * (p_ - end_)) : peak / (4 * dhat_p_ * (p_ - end_));
  a1_ = a2_ * (1 - end_ / p_);
  c1_ = a2_ * (end_ - p_) * (end_ - p_) - p_ * p_ * a1_;
}

// plain: W = peak dhat_a / 2. squared: W = peak dhat_a^2 / (4 dhat_p).
double FangAdhesion::range_of_work(double peak, double work) const {
  return form_ == Form::plain ? 2 * work / peak : std::sqrt(4 * dhat_p_ * work / peak);
}

double FangAdhesion::peak_traction() const {
  if (form_ == Form::plain) return at(dhat_p_).slope;
  // beyond dhat_p the traction 4 a2 d (d^2 - dhat_a^2) is largest at dhat_a / sqrt(3)
  return at(std::max(dhat_p_, dhat_a_ / std::sqrt(3.0))).slope;
}

TACK_REGISTER(AdhesionLaw, FangAdhesion, "fang",
              "Distance-based adhesion with a peak traction Y eps_c.",
              "Fang et al., Augmented Incremental Potential Contact, eq. 10-12");

}  // namespace tack
