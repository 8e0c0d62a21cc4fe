// Laws that violate the assumptions of contact.
#include "framework/checks/law_check.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tiny_scene.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;
using Catch::Contains;

namespace {

constexpr double e = 2.718281828459045, strength = 1000, peak = 1e-3;  // Pa, m

// Traction s (d / p) exp(1 - d / p) (Xu and Needleman 1993), cut at so many p; with `shift`, its energy ends at zero.
class Exponential : public NormalLawOf<Exponential, NormalAdhesion> {
 public:
  explicit Exponential(double cut, bool shift = false) : cut_(cut), shift_(shift ? (1 + cut) * std::exp(-cut) : 0) {}
  void fields(Fields&) override {}
  void prepare(const PairMaterials&) override {}
  double range() const override { return cut_ * peak; }
  double peak_traction() const override { return strength; }
  double work_of_adhesion() const override { return e * strength * peak * (1 - shift_); }
  template <class T>
  T energy(const T& d) const {
    using std::exp;
    const T u = d / T(peak);
    return T(-e * strength * peak) * ((T(1) + u) * exp(-u) - T(shift_));
  }

 private:
  double cut_, shift_;
};

// A smooth law with derivatives that are wrong by a factor.
class Skewed : public Exponential {
 public:
  Skewed(double slope, double curvature) : Exponential(30), slope_(slope), curvature_(curvature) {}
  void add_samples(int n, const double* d, LawSample* out) const override {
    std::vector<LawSample> mine(n);
    Exponential::add_samples(n, d, mine.data());
    for (int i = 0; i < n; ++i) {
      out[i].value += mine[i].value;
      out[i].slope += slope_ * mine[i].slope;
      out[i].curvature += curvature_ * mine[i].curvature;
    }
  }

 private:
  double slope_, curvature_;
};

class Boastful : public Exponential {
 public:
  Boastful() : Exponential(30) {}
  double peak_traction() const override { return 2 * strength; }
  double work_of_adhesion() const override { return 1.2 * e * strength * peak; }
};

}  // namespace

TEST_CASE("a smooth law with correct statements gives no warnings", "[law_check]") {
  const LawCheck check = check_law(Exponential(30));
  CHECK(check.errors.empty());
  CHECK(check.warnings.empty());
}

TEST_CASE("a traction or an energy that jumps at the range is warned of", "[law_check]") {
  const LawCheck cut = check_law(Exponential(3));
  CHECK(cut.errors.empty());
  CHECK_THAT(first_text(cut.warnings, WarningKind::law_traction_jump), Contains("traction jumps from 406 Pa to 0 at its range, 0.003 m (41% of the largest)"));  // 3 exp(-2)
  CHECK_THAT(first_text(cut.warnings, WarningKind::law_energy_jump), Contains("energy jumps from -0.5413 J/m^2 to 0 at its range"));                           // e s p 4 exp(-3)
  const LawCheck shifted = check_law(Exponential(3, true));
  CHECK_THAT(only_text(shifted.warnings, WarningKind::law_traction_jump), Contains("0.003 m"));
}

TEST_CASE("derivatives of a law that disagree are wrong", "[law_check]") {
  CHECK(check_law(Skewed(1, 1)).errors.empty());
  const LawCheck slope = check_law(Skewed(1.01, 1.01));
  CHECK_THAT(only_text(slope.errors, WarningKind::law_derivatives), Contains("its traction is not the derivative of its energy"));
  const LawCheck curvature = check_law(Skewed(1, 0.9));
  CHECK_THAT(only_text(curvature.errors, WarningKind::law_derivatives), Contains("its curvature is not the derivative of its traction"));
}

TEST_CASE("a law with values that are not finite is an error", "[law_check]") {
  CHECK_THAT(only_text(check_law(Skewed(1, std::numeric_limits<double>::infinity())).errors, WarningKind::law_not_finite), Contains("within its range of 0.03 m"));
}

TEST_CASE("a law with a wrong stated peak or work is warned of", "[law_check]") {
  const LawCheck check = check_law(Boastful());
  REQUIRE(check.warnings.size() == 2);
  CHECK_THAT(first_text(check.warnings, WarningKind::law_statement), Contains("states a peak traction of 2000 Pa, and has"));
  CHECK_THAT(check.warnings[1].text, Contains("states a work of adhesion of 3.262 J/m^2, and has 2.718"));
}

TEST_CASE("a peak within the contact distance is warned of, a peak beyond is not", "[law_check]") {
  const auto check = [](double contact_distance) {
    std::shared_ptr<BarrierLaw> barrier = Registry<BarrierLaw>::make("clamped_log");
    barrier->prepare({.contact_distance = contact_distance, .softer_young = 1e6, .adhesion_peak = strength});
    PairLaw pair;
    pair.add(barrier);
    pair.add(std::make_shared<Exponential>(30));
    return check_pair(pair);
  };
  const LawCheck within = check(3 * peak);
  CHECK(within.errors.empty());
  CHECK_THAT(only_text(within.warnings, WarningKind::law_peak_in_barrier), Contains("its traction peaks at 0.001 m, within the contact distance of 0.003 m"));
  const LawCheck beyond = check(0.9 * peak);
  CHECK(beyond.errors.empty());
  CHECK(beyond.warnings.empty());
}

TEST_CASE("a peak between sample points is found, and remarks of laws are passed on", "[law_check]") {
  const auto narrow = bind_component<AdhesionLaw>(parse_string("{type: lennard_jones, work_of_adhesion: 1, range: 0.3 m}", "test.yaml"));
  narrow->prepare({.contact_distance = 1e-3});  // sample points are 0.75 equilibrium gaps apart
  const LawCheck check = check_law(dynamic_cast<const NormalAdhesion&>(*narrow));
  CHECK(check.errors.empty());
  CHECK(check.warnings.empty());
  REQUIRE(check.notes.size() == 1);
  CHECK_THAT(check.notes[0], Contains("of its work would be done beyond its range, 0.3 m"));
}

TEST_CASE("remarks of the envelope of a bond law are passed on", "[law_check]") {
  const std::string scene = tiny_scene_with("{type: fang, critical_strain: 0.001}", "{type: damage, envelope: {type: table, file: '" TACK_TEST_DATA "/laws/six_rows.csv'}}");
  const LawCheck all = check_laws(*TestScene(scene.substr(scene.find("time:"))).world);
  CHECK((all.errors.empty() && all.warnings.empty()));
  REQUIRE(all.notes.size() == 1);
  CHECK_THAT(all.notes[0], Contains("6 rows of "));
}

TEST_CASE("the laws of scenes are checked with the names of their pairs", "[law_check]") {
  for (const char* right : {"{type: documented, strength: 2 kPa, range: 4 mm}", "{type: fang, critical_strain: 0.001}", "{type: fang, form: squared, critical_strain: 0.001}",
                            "{type: xu_needleman, peak_traction: 1 kPa}", "{type: dugdale, peak_traction: 1 kPa}", "{type: lennard_jones, peak_traction: 1 kPa}",
                            "{type: table, file: '" TACK_TEST_DATA "/laws/six_rows.csv'}", "{type: expression, traction: 1e12 * d * (4e-3 - d)^2, range: 4 mm}"}) {
    const std::string scene = tiny_scene_with("{type: fang, critical_strain: 0.001}", right);
    const LawCheck all = check_laws(*TestScene(scene.substr(scene.find("time:"))).world);
    INFO(right);
    CHECK(all.errors.empty());
    CHECK(all.warnings.empty());
  }
}
