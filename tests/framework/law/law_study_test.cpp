// Metrics and curves of laws without a scene, against closed forms.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "framework/config/units.hpp"
#include "framework/law/demands.hpp"
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

double figure(const std::vector<LawFigure>& figures, const std::string& name) {
  for (const LawFigure& f : figures)
    if (f.name == name) return f.value;
  FAIL("no figure '" << name << "'");
  return 0;
}

bool has(const std::vector<LawFigure>& figures, const std::string& name) {
  return std::any_of(figures.begin(), figures.end(), [&](const LawFigure& f) { return f.name == name; });
}

}  // namespace

TEST_CASE("the figures of Fang's law are those of its closed form", "[law]") {
  // Traction Y eps_c at dhat_p, W = Y eps_c dhat_a / 2; a triangle, which falls from 0.9 to 0.1 over 0.8 (dhat_a - dhat_p).
  const StudiedLaw fang = law("fang", {"young=2 MPa", "critical_strain=0.01", "peak_distance=1.5 mm", "range=4 mm"}, 1e6);
  const GapStudy study = study_gap_law(fang, {.speed = 1e-3, .pressure = {}});
  const auto& f = study.figures;
  CHECK(figure(f, "peak traction") == Approx(2e4).epsilon(1e-6));
  CHECK(figure(f, "gap of the peak") == Approx(1.5e-3).epsilon(1e-6));
  CHECK(figure(f, "range") == Approx(4e-3));
  CHECK(figure(f, "work of adhesion") == Approx(40).epsilon(1e-12));
  CHECK(figure(f, "work integrated") == Approx(40).epsilon(1e-6));
  CHECK(figure(f, "process zone") == Approx(1e6 * 40 / 4e8));
  CHECK(figure(f, "mesh size") == Approx(1e6 * 40 / 4e8 / 3));
  CHECK(figure(f, "gap change across an element") == Approx(1e-3));
  CHECK(figure(f, "way per step") == Approx(0.1 * 0.8 * 2.5e-3).epsilon(1e-4));
  CHECK(figure(f, "time step") == Approx(0.1 * 0.8 * 2.5).epsilon(1e-4));
  const PairLaw::Well well = fang.pair.well();
  CHECK(figure(f, "depth of the well") == well.depth);
  CHECK(well.depth < 40);
  CHECK(std::abs(fang.pair.at(figure(f, "rest gap")).slope) < 1);  // Pa
  for (const GapPoint& p : study.curve)
    if (p.gap < 1.5e-3) CHECK(p.traction == Approx(2e4 * p.gap / 1.5e-3));
}

TEST_CASE("the figures of RCC are those of its closed form, in each direction", "[law]") {
  constexpr double stiffness = 3e8, across = 1e8, work = 2;  // C_N, C_T, W
  const BondStudy study = study_bond_law(law("rcc", {"normal_stiffness=3e8", "tangential_stiffness=1e8", "work_of_adhesion=2"}), {});
  const auto& f = study.figures;
  for (const auto& [name, c] : {std::pair("along the normal", stiffness), std::pair("at 45°", (stiffness + across) / 2), std::pair("across", across)}) {
    INFO(name);
    CHECK(figure(f, std::string("peak ") + name) == Approx(std::sqrt(work * c)).epsilon(1e-5));
    CHECK(figure(f, std::string("opening of the peak ") + name) == Approx(std::sqrt(work / c)).epsilon(1e-4));
    CHECK(figure(f, std::string("critical opening ") + name) == Approx(10 * std::sqrt(work / c)).epsilon(0.01));  // beta = W / k = 0.01
    CHECK(figure(f, std::string("work ") + name) == Approx(work * (1 - 0.005)).epsilon(1e-3));                     // W/2 (2 - (d_0/d)^2) up to there
  }
  CHECK(figure(f, "stiffness along the normal") == Approx(stiffness));
  CHECK(figure(f, "stiffness across") == Approx(across));
  CHECK_FALSE(has(f, "speed that tells"));
  CHECK(study.rates.empty());
  CHECK(study.healing.empty());
  REQUIRE(study.slow.size() == 3);
  REQUIRE(study.unloading.size() == 3);
}

TEST_CASE("what is unloaded comes back the way it went, and goes on where it was", "[law]") {
  // Bilinear: sigma = 1e4 at 2e-5, gone at 2e-4; unloads towards the origin with its intensity times the stiffness.
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

TEST_CASE("rate, healing and the steps of what is integrated are found by themselves", "[law]") {
  const std::vector<std::string> settings = {"normal_stiffness=1e8", "work_of_adhesion=1", "viscosity=0.01", "healing=1e-4", "saturation=10 kPa"};
  const BondStudy study = study_bond_law(law("rcc", settings), {});
  // 10% more work at v eta / (W d_0) = 0.15, d_0 = 1e-4 m; pressed with p_0: 1 - exp(-r p_0 t) of a bond.
  CHECK(figure(study.figures, "speed that tells") == Approx(1.5e-3).epsilon(0.05));
  CHECK(figure(study.figures, "time to heal") == Approx(std::numbers::ln2).epsilon(1e-3));
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
  // A bond of the intensity b is C_N d b up to k b = W, from b^2 C_N d: its peak is sqrt(W C_N) b^(3/2).
  for (const auto& [time, strength] : study.healing[1].strength)
    if (const double b = -std::expm1(-time); b > 0.011) CHECK(strength == Approx(1e4 * std::pow(b, 1.5)).epsilon(0.01));  // less is no bond
  CHECK(has(study_bond_law(law("rcc_explicit", settings), {}).figures, "longest time step"));
  CHECK(figure(study_bond_law(law("rcc_explicit", settings), {}).figures, "longest time step") == Approx(0.01));
  CHECK_FALSE(has(study.figures, "longest time step"));
}

TEST_CASE("a law integrated explicitly is parted in steps that are short enough for it", "[law]") {
  const BondStudy study = study_bond_law(law("rcc_explicit", {"normal_stiffness=1e8", "tangential_stiffness=1e8", "work_of_adhesion=1", "viscosity=0.3"}), {});
  CHECK(figure(study.figures, "peak along the normal") == Approx(1e4).epsilon(0.01));
  CHECK(figure(study.figures, "work along the normal") == Approx(1).epsilon(0.01));
}

TEST_CASE("bonds that are unstressed where surfaces touch balance the barrier, or are taken apart by it", "[law]") {
  const StudiedLaw rcc = law("rcc", {"normal_stiffness=1e8", "work_of_adhesion=1"});
  const double gap = figure(study_bond_law(rcc, {}).figures, "rest gap");
  CHECK(-rcc.pair.at(gap).slope == Approx(1e8 * gap));
  CHECK_FALSE(std::isfinite(figure(study_bond_law(law("bonded", {"peak_traction=1e4"}), {}).figures, "rest gap")));
}

TEST_CASE("what breaks at once, and what never falls", "[law]") {
  const BondStudy brittle = study_bond_law(law("bonded", {"peak_traction=1e4"}), {});
  CHECK(figure(brittle.figures, "way per step") == Approx(1e-7).epsilon(0.01));
  CHECK(fall_of({{0, 0}, {1, 1}, {2, 2}}).way() == 0);
  CHECK(fall_of({{0, 0}, {1, 1}, {3, 0}}).way() == Approx(1.6));
  CHECK(fall_of({}).way() == 0);
}

TEST_CASE("the contact distance gives way to laws of a smaller scale, unless it is given", "[law]") {
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
  const double soft = study_gap_law(laws_of(source).at(0), {}).figures.at(7).value;
  source.barrier_stiffness = 1e5;
  CHECK(soft > study_gap_law(laws_of(source).at(0), {}).figures.at(7).value);  // a stiffer barrier takes more of the work
}

TEST_CASE("pictures of laws have axes with units, and what they are to show", "[law]") {
  const auto gap = law_plots("fang", study_gap_law(law("fang", {"peak_traction=1e4"}), {}));
  REQUIRE(gap.contains("traction"));
  CHECK(gap.at("traction").x_unit == "m");
  CHECK(gap.at("traction").y_unit == "Pa");
  CHECK(gap.at("traction").curves.size() == 2);
  CHECK(gap.at("energy").y_unit == "J/m^2");
  const auto bonds = law_plots("rcc", study_bond_law(law("rcc", {"normal_stiffness=1e8", "work_of_adhesion=1", "viscosity=0.01", "healing=1e-4"}), {}));
  CHECK(bonds.size() == 7);  // it holds at 45 degrees, and not across
  for (const char* name : {"traction", "energy", "intensity", "unloading", "rate", "healing"}) {
    INFO(name);
    REQUIRE(bonds.contains(name));
    for (const Curve& c : bonds.at(name).curves) CHECK(c.points.size() > 10);
  }
  CHECK(bonds.at("rate").curves.size() == 4);
  CHECK(law_plots("rcc", study_bond_law(law("rcc", {"normal_stiffness=1e8", "tangential_stiffness=1e8", "work_of_adhesion=1"}), {})).contains("unloading_45"));
}
