// Metrics and curves of laws without a scene, against closed forms.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "framework/config/units.hpp"
#include "framework/law/scene_requirements.hpp"
#include "framework/law/law_plots.hpp"
#include "framework/law/law_source.hpp"

using namespace tack;

namespace {

StudiedLaw law(const std::string& type, const std::vector<std::string>& settings, double young = 0) {
  LawSource source;
  source.type = type;
  source.settings = settings;
  if (young > 0) source.young = young;
  return laws_of(source).at(0);
}

double quantity_of(const std::vector<KeyQuantity>& quantities, const std::string& name) {
  for (const KeyQuantity& f : quantities)
    if (f.name == name) return f.value;
  FAIL("no quantity '" << name << "'");
  return 0;
}

bool has(const std::vector<KeyQuantity>& quantities, const std::string& name) {
  return std::any_of(quantities.begin(), quantities.end(), [&](const KeyQuantity& f) { return f.name == name; });
}

}  // namespace

TEST_CASE("key quantities of Fang's law agree with its closed form", "[law]") {
  // A triangle with peak Y eps_c at dhat_p and W = Y eps_c dhat_a / 2. The traction falls from 0.9 to 0.1 of the peak over 0.8 (dhat_a - dhat_p).
  const StudiedLaw fang = law("fang", {"young=2 MPa", "critical_strain=0.01", "peak_distance=1.5 mm", "range=4 mm"}, 1e6);
  const GapStudy study = study_gap_law(fang, {.speed = 1e-3, .pressure = {}});
  const auto& f = study.quantities;
  CHECK(quantity_of(f, "peak traction") == Approx(2e4).epsilon(1e-6));
  CHECK(quantity_of(f, "gap of the peak") == Approx(1.5e-3).epsilon(1e-6));
  CHECK(quantity_of(f, "range") == Approx(4e-3));
  CHECK(quantity_of(f, "work of adhesion") == Approx(40).epsilon(1e-12));
  CHECK(quantity_of(f, "work integrated") == Approx(40).epsilon(1e-6));
  CHECK(quantity_of(f, "process zone") == Approx(1e6 * 40 / 4e8));
  CHECK(quantity_of(f, "mesh size") == Approx(1e6 * 40 / 4e8 / 3));
  CHECK(quantity_of(f, "gap change across an element") == Approx(1e-3));
  CHECK(quantity_of(f, "displacement per step") == Approx(0.1 * 0.8 * 2.5e-3).epsilon(1e-4));
  CHECK(quantity_of(f, "time step") == Approx(0.1 * 0.8 * 2.5).epsilon(1e-4));
  const PairLaw::Well well = fang.pair.well();
  CHECK(quantity_of(f, "depth of the well") == well.depth);
  CHECK(well.depth < 40);
  CHECK(std::abs(fang.pair.at(quantity_of(f, "rest gap")).slope) < 1);  // Pa
  for (const GapPoint& p : study.curve)
    if (p.gap < 1.5e-3) CHECK(p.traction == Approx(2e4 * p.gap / 1.5e-3));
}

TEST_CASE("sheets need elements by the length over which they bend", "[law]") {
  StudiedLaw fang = law("fang", {"young=2 MPa", "critical_strain=0.01", "peak_distance=1.5 mm", "range=4 mm"}, 0);
  CHECK(has(study_gap_law(fang, {}).quantities, "process zone per modulus"));
  fang.bending_stiffness = 1e-5;
  const auto quantities = study_gap_law(fang, {}).quantities;
  const double length = std::pow(2 * 1e-5 * 40 / 4e8, 0.25);  // W = 40 J/m^2, a peak of 20 kPa
  CHECK(quantity_of(quantities, "bending length") == Approx(length));
  CHECK(quantity_of(quantities, "mesh size of a sheet or a rod") == Approx(length / 2));
  CHECK_FALSE(has(quantities, "process zone"));
  CHECK_FALSE(has(quantities, "process zone per modulus"));
}

TEST_CASE("key quantities of RCC agree with its closed form in each direction", "[law]") {
  constexpr double stiffness = 3e8, across = 1e8, work = 2;  // C_N, C_T, W
  const BondStudy study = study_bond_law(law("rcc", {"normal_stiffness=3e8", "tangential_stiffness=1e8", "work_of_adhesion=2"}), {});
  const auto& f = study.quantities;
  for (const auto& [name, c] : {std::pair("along the normal", stiffness), std::pair("at 45°", (stiffness + across) / 2), std::pair("across", across)}) {
    INFO(name);
    CHECK(quantity_of(f, std::string("peak ") + name) == Approx(std::sqrt(work * c)).epsilon(1e-5));
    CHECK(quantity_of(f, std::string("opening of the peak ") + name) == Approx(std::sqrt(work / c)).epsilon(1e-4));
    CHECK(quantity_of(f, std::string("critical opening ") + name) == Approx(10 * std::sqrt(work / c)).epsilon(0.01));  // beta = W / k = 0.01
    CHECK(quantity_of(f, std::string("work ") + name) == Approx(work * (1 - 0.005)).epsilon(1e-3));                     // W/2 (2 - (d_0/d)^2) up to there
  }
  CHECK(quantity_of(f, "stiffness along the normal") == Approx(stiffness));
  CHECK(quantity_of(f, "stiffness across") == Approx(across));
  CHECK_FALSE(std::isfinite(quantity_of(f, "speed that tells")));
  CHECK_FALSE(study.scan.rate_dependent());
  CHECK(study.rates.empty());
  CHECK(study.healing.empty());
  REQUIRE(study.slow.size() == 3);
  REQUIRE(study.unloading.size() == 3);
}

TEST_CASE("bilinear bonds unload along the secant and reload to the envelope", "[law]") {
  // The envelope has its peak of 1e4 Pa at 2e-5 m and ends at 2e-4 m. Unloading goes towards the origin with intensity times stiffness.
  const BondStudy study = study_bond_law(law("bilinear", {"peak_traction=1e4", "work_of_adhesion=1"}), {});
  REQUIRE(!study.unloading.empty());
  const BondPath& path = study.unloading.front();
  double farthest = 0, before = 0;
  int backward = 0, forward = 0;
  for (const BondPoint& p : path.points) {
    const double envelope = p.opening < 2e-5 ? 5e8 * p.opening : std::max(0.0, 1e4 * (2e-4 - p.opening) / 1.8e-4);
    if (p.opening >= farthest) {
      CHECK(p.traction == Approx(envelope).margin(1e-6));
    } else {
      CHECK(p.traction == Approx(p.intensity * 5e8 * p.opening).margin(1e-6));
      (p.opening < before ? backward : forward) += 1;
    }
    farthest = std::max(farthest, p.opening), before = p.opening;
  }
  CHECK(backward > 100);
  CHECK(forward > 100);
  CHECK(path.points.back().dissipated == Approx(1).epsilon(1e-3));
  CHECK(path.points.back().intensity == 0);
}

TEST_CASE("a study finds rate effects, healing times and the steps of explicit laws", "[law]") {
  const std::vector<std::string> settings = {"normal_stiffness=1e8", "work_of_adhesion=1", "viscosity=0.01", "healing=1e-4", "saturation=10 kPa"};
  const BondStudy study = study_bond_law(law("rcc", settings), {});
  // The work is 10% larger at v eta / (W d_0) = 0.15 with d_0 = 1e-4 m. Under the pressure p_0, the intensity is 1 - exp(-r p_0 t).
  CHECK(quantity_of(study.quantities, "speed that tells") == Approx(1.5e-3).epsilon(0.05));
  CHECK(quantity_of(study.quantities, "time to heal") == Approx(std::numbers::ln2).epsilon(1e-3));
  REQUIRE(study.rates.size() == 3);
  double peak = 1e4;
  for (const BondPath& rate : study.rates) {
    double own = 0;
    for (const BondPoint& p : rate.points) own = std::max(own, p.traction);
    CHECK(own > peak);
    peak = own;
  }
  REQUIRE(study.healing.size() == 3);
  CHECK(study.healing[1].pressure == 1e4);
  // A bond of intensity b has the peak sqrt(W C_N) b^(3/2).
  for (const auto& [time, strength] : study.healing[1].strength)
    if (const double b = -std::expm1(-time); b > 0.011) CHECK(strength == Approx(1e4 * std::pow(b, 1.5)).epsilon(0.01));  // below 0.01 the bond does not exist
  CHECK(has(study_bond_law(law("rcc_explicit", settings), {}).quantities, "longest time step"));
  CHECK(quantity_of(study_bond_law(law("rcc_explicit", settings), {}).quantities, "longest time step") == Approx(0.01));
  CHECK_FALSE(has(study.quantities, "longest time step"));
}

TEST_CASE("a study tells laws with a band of rates from viscous and rate-independent ones", "[law]") {
  // Standard linear solid, K = 1e8 Pa/m, d_f = 0.2 mm, tau = 50 ms, K_1 = 3 K: the peak doubles, the work has a largest value near d_f / tau.
  const std::vector<std::string> solid = {"peak_traction=1e4", "work_of_adhesion=1", "stiffness=1e8", "branch_stiffness=3e8", "relaxation_time=50 ms"};
  const BondStudy study = study_bond_law(law("viscoelastic", solid), {});
  const auto& f = study.quantities;
  const double speed = 2e-4 / 0.05;
  CHECK(study.scan.rate_dependent());
  CHECK(study.scan.slow.peak == Approx(1e4).epsilon(0.01));
  CHECK(study.scan.points.front().work == Approx(1).epsilon(0.01));
  CHECK(study.scan.points.back().work == Approx(1).epsilon(0.01));
  CHECK(study.scan.points.back().peak == Approx(2e4).epsilon(0.01));
  CHECK(quantity_of(f, "largest peak at speed") == Approx(2e4).epsilon(0.01));
  const double largest = quantity_of(f, "largest work at speed");
  CHECK(largest > 1.3);
  for (const RatePoint& p : study.scan.points) CHECK(p.work <= largest * (1 + 1e-3));
  CHECK(study.scan.largest_speed > 0.1 * speed);
  CHECK(study.scan.largest_speed < 10 * speed);
  CHECK(quantity_of(f, "speed that changes the work") < study.scan.largest_speed);
  CHECK(quantity_of(f, "speed that tells") == std::min(quantity_of(f, "speed that changes the work"), quantity_of(f, "speed that changes the peak")));
  const auto remark = [](const std::vector<KeyQuantity>& all, const std::string& name) {
    for (const KeyQuantity& q : all)
      if (q.name == name) return q.remark;
    return std::string();
  };
  CHECK_THAT(remark(f, "speed that changes the work"), Catch::Contains("back within 10% from"));
  CHECK_THAT(remark(f, "largest peak at speed"), Catch::Contains("at the end of the scan"));
  CHECK(study.rates.size() == 3);
  // A tenth of the relaxation time is a tenth of the speed.
  const BondStudy slower = study_bond_law(law("viscoelastic", {"peak_traction=1e4", "work_of_adhesion=1", "stiffness=1e8", "branch_stiffness=3e8", "relaxation_time=500 ms"}), {});
  CHECK(quantity_of(slower.quantities, "speed that tells") == Approx(quantity_of(f, "speed that tells") / 10).epsilon(1e-3));

  const auto viscous = study_bond_law(law("rcc", {"normal_stiffness=1e8", "work_of_adhesion=1", "viscosity=0.01"}), {});
  CHECK(viscous.scan.rate_dependent());
  CHECK(viscous.scan.largest_speed == 0);
  CHECK_THAT(remark(viscous.quantities, "speed that changes the work"), !Catch::Contains("back within"));
  CHECK_THAT(remark(viscous.quantities, "largest work at speed"), Catch::Contains("at the end of the scan"));

  const std::vector<std::string> bilinear = {"peak_traction=1e4", "work_of_adhesion=1"};
  const auto independent = study_bond_law(law("bilinear", bilinear), {});
  CHECK_FALSE(independent.scan.rate_dependent());
  CHECK_THAT(remark(independent.quantities, "speed that tells"), Catch::Contains("independent of the rate"));
  CHECK(independent.rates.empty());
  // Curves at a chosen speed are drawn of every law; the fast one needs shorter steps.
  CHECK(study_bond_law(law("bilinear", bilinear), {.speed = 1e-3, .pressure = {}}).rates.size() == 3);
  const BondStudy chosen = study_bond_law(law("viscoelastic", solid), {.speed = 100 * speed, .pressure = {}});
  REQUIRE(chosen.rates.size() == 3);
  CHECK(chosen.rates[1].speed == 100 * speed);
  CHECK(quantity_of(chosen.quantities, "time step") == Approx(0.1 * 0.8 * 0.5e-4 / (100 * speed)).epsilon(0.05));  // d_0, d_f halved
}

TEST_CASE("the study of an explicitly integrated law takes short enough steps", "[law]") {
  const BondStudy study = study_bond_law(law("rcc_explicit", {"normal_stiffness=1e8", "tangential_stiffness=1e8", "work_of_adhesion=1", "viscosity=0.3"}), {});
  CHECK(quantity_of(study.quantities, "peak along the normal") == Approx(1e4).epsilon(0.01));
  CHECK(quantity_of(study.quantities, "work along the normal") == Approx(1).epsilon(0.01));
}

TEST_CASE("bonds that are unstressed at zero gap balance the barrier, or break under it", "[law]") {
  const StudiedLaw rcc = law("rcc", {"normal_stiffness=1e8", "work_of_adhesion=1"});
  const double gap = quantity_of(study_bond_law(rcc, {}).quantities, "rest gap");
  CHECK(-rcc.pair.at(gap).slope == Approx(1e8 * gap));
  CHECK_FALSE(std::isfinite(quantity_of(study_bond_law(law("bonded", {"peak_traction=1e4"}), {}).quantities, "rest gap")));
}

TEST_CASE("the softening range of brittle laws is the opening, and that of rising tractions is empty", "[law]") {
  const BondStudy brittle = study_bond_law(law("bonded", {"peak_traction=1e4"}), {});
  CHECK(quantity_of(brittle.quantities, "displacement per step") == Approx(1e-7).epsilon(0.01));
  CHECK(softening_range({{0, 0}, {1, 1}, {2, 2}}).width() == 0);
  CHECK(softening_range({{0, 0}, {1, 1}, {3, 0}}).width() == Approx(1.6));
  CHECK(softening_range({}).width() == 0);
}

TEST_CASE("the default contact distance shrinks below the peak of a short-range law", "[law]") {
  const StudiedLaw small = law("dugdale", {"peak_traction=1 MPa", "work_of_adhesion=1"});  // to 1 um
  CHECK(small.contact_distance == Approx(4e-7));
  CHECK(law("dugdale", {"peak_traction=1 kPa", "work_of_adhesion=10"}).contact_distance == 1e-3);
  LawSource source;
  source.type = "dugdale";
  source.settings = {"peak_traction=1 MPa", "work_of_adhesion=1"};
  source.contact_distance = 1e-3;
  CHECK_THROWS_WITH(laws_of(source), Catch::Contains("within the contact distance 0.001 m"));
  source.contact_distance = 2e-7;
  source.barrier_stiffness = 100;
  const double soft = study_gap_law(laws_of(source).at(0), {}).quantities.at(7).value;
  source.barrier_stiffness = 1e5;
  CHECK(soft > study_gap_law(laws_of(source).at(0), {}).quantities.at(7).value);  // a stiffer barrier makes the well shallower
}

TEST_CASE("plots of laws have axes with units and all curves", "[law]") {
  const auto gap = law_plots("fang", study_gap_law(law("fang", {"peak_traction=1e4"}), {}));
  REQUIRE(gap.contains("traction"));
  CHECK(gap.at("traction").x_unit == "m");
  CHECK(gap.at("traction").y_unit == "Pa");
  CHECK(gap.at("traction").curves.size() == 2);
  CHECK(gap.at("energy").y_unit == "J/m^2");
  const auto bonds = law_plots("rcc", study_bond_law(law("rcc", {"normal_stiffness=1e8", "work_of_adhesion=1", "viscosity=0.01", "healing=1e-4"}), {}));
  CHECK(bonds.size() == 9);  // traction at 45 degrees, none across
  for (const char* name : {"traction", "energy", "intensity", "unloading", "rate", "peak_over_speed", "work_over_speed", "healing"}) {
    INFO(name);
    REQUIRE(bonds.contains(name));
    for (const Curve& c : bonds.at(name).curves) CHECK(c.points.size() > 10);
  }
  CHECK(bonds.at("rate").curves.size() == 4);
  CHECK(law_plots("rcc", study_bond_law(law("rcc", {"normal_stiffness=1e8", "tangential_stiffness=1e8", "work_of_adhesion=1"}), {})).contains("unloading_45"));
}
