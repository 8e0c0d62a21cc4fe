// Every adhesion by bonds, with every option, whatever laws exist.
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <random>

#include "framework/config/field.hpp"
#include "tests/support/bond_laws.hpp"
#include "tests/support/dense_term.hpp"

using namespace tack;

namespace {

const std::vector<std::map<std::string, std::string>> settings = {
    {},
    {{"envelope", "{type: fang, peak_traction: 1e4, peak_distance: 5e-5, range: 2e-4}"}},
    {{"envelope", "{type: expression, traction: 1e12 * d * exp(-d / 1e-5), range: 2e-4}"}, {"viscosity", "0.02"}},
    {{"envelope", "{type: table, file: " TACK_TEST_DATA "/laws/six_rows.csv}"}, {"tangential_strength", "5e3"}},
    {{"activation_energy", "6e4"}, {"reference_temperature", "300"}},
    {{"law", "{type: bilinear, peak_traction: 1e4, work_of_adhesion: 1}"}},
    {{"branch_stiffness", "4e9"}, {"relaxation_time", "3e-3"}, {"tangential_strength", "5e3"}},
    {{"tangential_stiffness", "5e7"}},
    {{"tangential_stiffness", "5e7"}, {"viscosity", "0.02"}},
    {{"tangential_stiffness", "2e7"}, {"viscosity", "1e-3"}, {"healing", "1e-3"}, {"saturation", "2e3"}},
    {{"tangential_stiffness", "2e7"}, {"healing", "1e-3"}},
    {{"tangential_strength", "5e3"}},
    {{"tangential_strength", "5e3"}, {"viscosity", "0.02"}},
    {{"tangential_strength", "0"}, {"onset", "1e-5"}},
    {{"mixity_exponent", "1.5"}, {"tangential_strength", "2e4"}, {"tangential_work", "3"}},
    {{"tangential_strength", "2e4"}, {"tangential_work", "3"}, {"viscosity", "0.02"}}};

double scale_of(const BondLaw& law) { return law.work_of_adhesion() / law.peak_traction(); }  // m

// Returns whether the law has viscous dissipation that its intensity does not tell.
bool flows(BondLaw& law) {
  const Fields fields = fields_of(law);
  return fields.find("relaxation_time") != nullptr;
}

// Viscosity of the law; 0 if it has none. The potential of a step contains half of the viscous dissipation.
double viscosity_of(const std::string& type, BondLaw& law) {
  if (type == "rcc_explicit") return 0;  // that of a step is a spring, and all that the update takes is dissipated
  const Fields fields = fields_of(law);
  const Field* f = fields.find("viscosity");
  return f ? std::stod(f->write().text) : 0;
}

// check(law, type) for every variant.
template <class Check>
void for_each_law(const Check& check) {
  const auto all = variants<AdhesionLaw, BondLaw>(settings);
  REQUIRE(!all.empty());
  for (const ComponentVariant& v : all) {
    const auto law = bond_law(v.yaml);
    INFO(v.yaml);
    check(*law, v.type);
  }
}

struct Situation {
  PulledBond bond;
  double d, u, h;
};

// A bond with some past, not gone, and a place it is pulled to.
Situation some_situation(const BondLaw& law, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0, 1);
  const double scale = scale_of(law), h = std::pow(10, -4 + 3 * share(random));
  const auto some = [&] { return scale * std::pow(10, -1.5 + 2 * share(random)); };
  while (true) {
    Situation it{PulledBond(law), 0, 0, h};
    const int past = static_cast<int>(4 * share(random));
    for (int i = 0; i < past; ++i) {
      const double d = share(random) < 0.2 ? 0 : 0.3 * some(), u = 0.3 * some();
      it.bond.step(d, u, h);
    }
    it.d = some(), it.u = some();
    if (!it.bond.change().gone) return it;
  }
}

double jump_of(const BondSample& a, const BondSample& b) {
  const auto of = [](double p, double q) { return std::abs(p - q) / std::max(1e-300, std::abs(p) + std::abs(q)); };
  return std::max({of(a.by_dd, b.by_dd), of(a.by_ds, b.by_ds), of(a.by_ss, b.by_ss)});
}

// Returns the largest change of the force along a ray, by repeated refinement around it.
double force_jump(const BondLaw& law, const double* history, double h, double d, double u) {
  const auto force = [&](double t) {
    const BondSample s = law.at(t * d, t * t * u * u, history, h);
    return Vec2(s.by_d, 2 * s.by_s * t * u);
  };
  double low = law.directed() ? 1e-9 : 0, high = 1, most = 0;  // a directed law pulls at no slip where slip has flowed
  for (int parts = 1024; high - low > 1e-12; parts = 4) {
    const double width = (high - low) / parts, from = low;
    most = 0;
    for (int i = 0; i < parts; ++i) {
      const double at = from + i * width, change = (force(at + width) - force(at)).norm();
      if (change >= most) most = change, low = at;
    }
    high = low + width;
  }
  return most;
}

}  // namespace

TEST_CASE("bonds: derivatives", "[bonds]") {
  for_each_law([](const BondLaw& law, const std::string&) {
    std::mt19937 random(1);
    int kinks = 0, tried = 400;
    for (int i = 0; i < tried; ++i) {
      Situation it = some_situation(law, random);
      const double d = it.d, s = it.u * it.u, e = 1e-4;
      const auto at = [&](double p, double q) { return law.at(d * (1 + p), s * (1 + q), it.bond.history(), it.h); };
      const BondSample here = at(0, 0);
      if (jump_of(at(-2 * e, -2 * e), at(2 * e, 2 * e)) > 0.05) {
        ++kinks;
        continue;
      }
      // Derivatives by ln d and ln s, which have one unit.
      const double scale = std::abs(here.value) + law.work_of_adhesion() * 1e-6 + std::abs(here.by_d * d) + std::abs(here.by_s * s) +
                           std::abs(here.by_dd * d * d) + std::abs(here.by_ds * d * s) + std::abs(here.by_ss * s * s);
      // A central difference is a mean of the derivative over [-2e, 2e], of weights whose sum is 1. From the derivative in the middle it
      // differs by at most half of the second difference where the derivative jumps, and by a twelfth where it has a kink.
      const auto check = [&](const auto& function, const auto& derivative) {
        const double found = derivative(0), bend = derivative(2 * e) - 2 * found + derivative(-2 * e);
        CHECK(std::abs(found - central_difference(function, e)) <= 1e-6 * scale + std::abs(bend) / 2);
      };
      check([&](double p) { return at(p, 0).value; }, [&](double p) { return at(p, 0).by_d * d; });
      check([&](double q) { return at(0, q).value; }, [&](double q) { return at(0, q).by_s * s; });
      check([&](double p) { return at(p, 0).by_d * d; }, [&](double p) { return at(p, 0).by_dd * d * d; });
      check([&](double q) { return at(0, q).by_d * d; }, [&](double q) { return at(0, q).by_ds * d * s; });
      check([&](double p) { return at(p, 0).by_s * s; }, [&](double p) { return at(p, 0).by_ds * d * s; });
      check([&](double q) { return at(0, q).by_s * s; }, [&](double q) { return at(0, q).by_ss * s * s; });
      double value = 0;
      law.add_values(1, &d, &s, it.bond.history(), it.h, &value);
      CHECK(value == Approx(here.value).epsilon(1e-13).margin(1e-13 * law.work_of_adhesion()));
    }
    CHECK(kinks < 0.1 * tried);
  });
}

TEST_CASE("bonds: forces do not jump", "[bonds]") {
  for_each_law([](const BondLaw& law, const std::string&) {
    std::mt19937 random(2);
    for (int i = 0; i < 10; ++i) {
      Situation it = some_situation(law, random);
      CHECK(force_jump(law, it.bond.history(), it.h, 10 * it.d, 10 * it.u) <= 1e-5 * law.peak_traction());
    }
  });
}

TEST_CASE("bonds: the potential of a step is stored or dissipated", "[bonds]") {
  for_each_law([](BondLaw& law, const std::string& type) {
    std::mt19937 random(3);
    const double viscosity = viscosity_of(type, law);
    for (int i = 0; i < 4000; ++i) {
      Situation it = some_situation(law, random);
      const double d = i % 4 == 3 ? -it.d : it.d;  // some are pressed
      const double before = it.bond.intensity(), value = law.at(d, it.u * it.u, it.bond.history(), it.h).value;
      it.bond.step(d, it.u, it.h);
      const BondChange& change = it.bond.change();
      const double lost = before - it.bond.intensity(), stored = change.gone ? 0 : law.stored(d, it.u * it.u, it.bond.history());
      INFO("intensity " << before << " -> " << it.bond.intensity() << ", h " << it.h);
      const double rounding = 1e-12 * (value + law.work_of_adhesion()), taken = value - stored;
      if (flows(law)) CHECK((taken <= change.dissipated + rounding && change.dissipated <= 2 * taken + rounding));
      else CHECK(std::abs(taken - (change.dissipated - viscosity * lost * lost / (2 * it.h))) <= rounding);
      CHECK(change.dissipated >= 0);
      CHECK(change.healed == 0);
      CHECK((it.bond.intensity() >= 0 && lost >= 0));
    }
  });
}

TEST_CASE("bonds: new bonds store no energy, intact bonds have an intensity of 1", "[bonds]") {
  for_each_law([](const BondLaw& law, const std::string&) {
    PulledBond bond(law);
    CHECK(bond.intensity() == 1);
    for (const double h : {0.0, 1e-3}) CHECK(law.at(0, 0, bond.history(), h).value == 0);
    CHECK(bond.step(0, 0, 1e-3).by_d == 0);
    CHECK((!bond.change().gone && bond.change().dissipated == 0 && bond.intensity() == 1));
    CHECK(law.clone()->width() == law.width());
    CHECK(law.traits().history_dependent == (law.width() > 0));
  });
}

TEST_CASE("bonds with history variables have at most one direction of negative curvature", "[bonds]") {
  for_each_law([](const BondLaw& law, const std::string&) {
    if (!law.traits().history_dependent) return;
    std::mt19937 random(4);
    for (int i = 0; i < 1000; ++i) {
      Situation it = some_situation(law, random);
      const BondSample s = law.at(it.d, it.u * it.u, it.bond.history(), it.h);
      const double mixed = 2 * s.by_ds * it.u, along = 4 * s.by_ss * it.u * it.u + 2 * s.by_s;
      const Eigen::Matrix2d hessian = (Eigen::Matrix2d() << s.by_dd, mixed, mixed, along).finished();
      const auto eigen = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(hessian, Eigen::EigenvaluesOnly).eigenvalues();
      if (!law.directed()) CHECK(s.by_s >= 0);
      CHECK(eigen[1] >= -1e-12 * std::abs(eigen[0]));
    }
  });
}

TEST_CASE("bonds pulled slowly: peak, work and dissipation are those of the law", "[bonds]") {
  for_each_law([](const BondLaw& law, const std::string& type) {
    if (type == "rcc_explicit") return;  // it has no slow limit at a fixed step size
    PulledBond bond(law);
    const double slowly = 1e6;
    bond.pull(3 * scale_of(law), 0, 20000, slowly);
    bond.pull(40 * scale_of(law), 0, 20000, slowly);
    CHECK(bond.peak() == Approx(law.peak_traction()).epsilon(2e-3));
    CHECK(bond.work() == Approx(law.work_of_adhesion()).epsilon(6e-3));  // some fail a little before the end
    CHECK(bond.dissipated() + bond.stored() == Approx(bond.work()).epsilon(1e-3));
  });
}
