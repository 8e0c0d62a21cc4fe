// The laws against tabulated values and closed forms.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/contact/normal_law.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/json.hpp"

using namespace tack;

namespace {

using Row = std::array<double, 4>;  // argument, value, first and second derivative

const nlohmann::json& tables() {
  static const nlohmann::json data = read_json(TACK_TEST_DATA "/scalars.json");
  return data;
}

std::unique_ptr<NormalAdhesion> fang(const std::string& settings, const PairMaterials& pair) {
  auto law = component<AdhesionLaw>("{type: fang, " + settings + "}");
  law->prepare(pair);
  return std::unique_ptr<NormalAdhesion>(dynamic_cast<NormalAdhesion*>(law.release()));
}

std::unique_ptr<NormalAdhesion> tabulated_fang(const std::string& form) {
  const auto& t = tables().at("normal_adhesion_" + form);
  return fang(fmt::format("form: {}, young: {}, critical_strain: {}, peak_distance: {}, range: {}", form,
                          t.at("young").get<double>(), t.at("critical_strain").get<double>(),
                          t.at("peak_distance").get<double>(), t.at("range").get<double>()),
              {1e-3, 0, 0});
}

double largest(const std::vector<Row>& rows, int column) {
  double m = 0;
  for (const Row& row : rows) m = std::max(m, std::abs(row[column]));
  return m;
}

void check_close(const LawSample& s, const Row& expected, const std::vector<Row>& rows) {
  INFO("argument " << expected[0]);
  CHECK(std::abs(s.value - expected[1]) <= 1e-13 * largest(rows, 1));
  CHECK(std::abs(s.slope - expected[2]) <= 1e-13 * largest(rows, 2));
  CHECK(std::abs(s.curvature - expected[3]) <= 1e-12 * largest(rows, 3));
}

// The message of the InputError, "" without one.
std::string error_of(const std::string& settings) {
  try {
    fang(settings, {1e-3, 1e4, 0});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("fang adhesion in the gap: tabulated values", "[laws]") {
  const auto law = tabulated_fang("plain");
  const auto rows = tables().at("normal_adhesion_plain").at("values").get<std::vector<Row>>();
  REQUIRE(rows.size() > 20);
  for (const Row& row : rows) check_close(law->at(row[0]), row, rows);
}

// The table is in s = d^2: phi' = 2 d phi_s, phi'' = 2 phi_s + 4 d^2 phi_ss.
TEST_CASE("fang adhesion in the squared gap: tabulated values", "[laws]") {
  const auto law = tabulated_fang("squared");
  auto rows = tables().at("normal_adhesion_squared").at("values").get<std::vector<Row>>();
  REQUIRE(rows.size() > 20);
  for (Row& row : rows) {
    const double d = std::sqrt(row[0]);
    row = {d, row[1], 2 * d * row[2], 2 * row[2] + 4 * d * d * row[3]};
  }
  for (const Row& row : rows) check_close(law->at(row[0]), row, rows);
}

// The table holds -(d - dhat)^2 ln(d/dhat); ours, -kappa dhat (d/dhat - 1)^2 ln(d/dhat) with kappa in
// pascals, is kappa / dhat times that.
TEST_CASE("clamped logarithmic barrier: tabulated values", "[laws]") {
  constexpr double kappa = 7e4;
  for (const auto& table : tables().at("clamped_log")) {
    const double dhat = table.at("dhat");
    const auto law = component<BarrierLaw>("{type: clamped_log, form: plain, stiffness: 7e4}");
    law->prepare({dhat, 1e6, 0});
    const auto rows = table.at("values").get<std::vector<Row>>();
    REQUIRE(rows.size() > 20);
    for (const Row& row : rows) {
      INFO("dhat " << dhat << ", gap " << row[0]);
      const LawSample s = law->at(row[0]);
      const double factor = kappa / dhat, fade = 1e-14 / std::max(1e-6, std::abs(1 - row[0] / dhat));
      CHECK(s.value == Approx(factor * row[1]).epsilon(1e-13 + 3 * fade));
      CHECK(s.slope == Approx(factor * row[2]).epsilon(1e-13 + 3 * fade));
      CHECK(s.curvature == Approx(factor * row[3]).epsilon(1e-13 + 3 * fade));
    }
  }
}

TEST_CASE("the barrier's two forms push equally at half the distance", "[laws]") {
  const auto plain = component<BarrierLaw>("{type: clamped_log, form: plain, stiffness: 3e4}");
  const auto squared = component<BarrierLaw>("{type: clamped_log, form: squared, stiffness: 3e4}");
  for (const double dhat : {1e-4, 1e-3, 0.2}) {
    plain->prepare({dhat, 0, 0});
    squared->prepare({dhat, 0, 0});
    CHECK(squared->at(dhat / 2).slope == Approx(plain->at(dhat / 2).slope).epsilon(1e-12));
    // g(1/2) = ln 2 + 1/2
    CHECK(plain->at(dhat / 2).slope == Approx(-3e4 * (std::log(2.0) + 0.5)).epsilon(1e-12));
  }
}

TEST_CASE("the barrier's default stiffness follows the softer side and the adhesion", "[laws]") {
  const auto slope = [](const PairMaterials& pair) {
    const auto law = component<BarrierLaw>("clamped_log");
    law->prepare(pair);
    return -law->at(pair.contact_distance / 2).slope / (std::log(2.0) + 0.5);
  };
  CHECK(slope({1e-3, 1e6, 0}) == Approx(1e5));
  CHECK(slope({1e-3, 1e6, 2e4}) == Approx(1e3));
  CHECK(slope({1e-3, 1e6, 1e8}) == Approx(1e5));
  CHECK(slope({1e-3, 0, 0}) == Approx(1e5));
}

TEST_CASE("fang adhesion: peak traction and work", "[laws]") {
  constexpr double young = 2e4, strain = 0.3, dhat = 0.8e-3, peak = young * strain;
  const PairMaterials pair{dhat, young, 0};
  const auto plain = fang("form: plain, critical_strain: 0.3", pair);  // Y: the softer side's
  CHECK(plain->range() == Approx(2 * dhat));
  CHECK(plain->at(dhat).slope == Approx(peak).epsilon(1e-13));
  CHECK(plain->peak_traction() == Approx(peak).epsilon(1e-13));
  CHECK(plain->work_of_adhesion() == Approx(peak * dhat).epsilon(1e-13));  // Y eps_c dhat_a / 2
  const auto squared = fang("form: squared, critical_strain: 0.3", pair);
  CHECK(squared->at(dhat).slope == Approx(peak).epsilon(1e-13));
  const double factor = 16 / (9 * std::sqrt(3.0));  // 1.0264
  CHECK(squared->peak_traction() == Approx(factor * peak).epsilon(1e-13));
  CHECK(squared->at(2 * dhat / std::sqrt(3.0)).slope == Approx(factor * peak).epsilon(1e-13));
  CHECK(squared->work_of_adhesion() == Approx(peak * dhat).epsilon(1e-13));
  // The traction is a triangle for any dhat_p, so that the work depends on dhat_a alone.
  const auto skewed = fang("critical_strain: 0.3, peak_distance: 0.9 mm, range: 5 mm", pair);
  CHECK(skewed->work_of_adhesion() == Approx(peak * 5e-3 / 2).epsilon(1e-13));
  CHECK(skewed->at(0.9e-3).slope == Approx(peak).epsilon(1e-13));
}

TEST_CASE("fang adhesion: the law has the given strength", "[laws]") {
  const std::string strength = "peak_traction: 5 kPa, work_of_adhesion: 9";
  const auto plain = fang(strength, {1e-3, 0, 0});
  CHECK(plain->work_of_adhesion() == Approx(9.0).epsilon(1e-13));
  CHECK(plain->peak_traction() == Approx(5e3).epsilon(1e-13));
  CHECK(plain->range() == Approx(2 * 9.0 / 5e3).epsilon(1e-13));
  const auto squared = fang("form: squared, " + strength, {1e-3, 0, 0});
  CHECK(squared->work_of_adhesion() == Approx(9.0).epsilon(1e-13));
  CHECK(squared->at(1e-3).slope == Approx(5e3).epsilon(1e-13));  // at dhat_p
}

TEST_CASE("fang adhesion: contradictory parameters are refused", "[laws]") {
  CHECK(error_of("critical_strain: 0.5").empty());
  CHECK(error_of("young: 1e3").find("critical_strain") != std::string::npos);
  CHECK(error_of("critical_strain: 0.5, peak_traction: 1e3").find("peak_traction") != std::string::npos);
  CHECK(error_of("critical_strain: 0.5, work_of_adhesion: 1").find("peak_traction") != std::string::npos);
  CHECK(error_of("peak_traction: 1e3, work_of_adhesion: 2, range: 3 mm").find("range") != std::string::npos);
  CHECK(error_of("critical_strain: 0.5, peak_distance: 2 mm, range: 2 mm").find("range") != std::string::npos);
  CHECK(error_of("critical_strain: 0.5, peak_distance: 0.9 mm").find("contact distance") != std::string::npos);
  CHECK(error_of("critical_strain: 0.5, range: 0.9 mm").find("peak_distance") != std::string::npos);
  // too little work for this peak: the range would lie below dhat_p
  CHECK(error_of("peak_traction: 1e3, work_of_adhesion: 1e-3").find("work_of_adhesion") != std::string::npos);
  CHECK(error_of("critical_strain: -0.5").find("positive") != std::string::npos);
  CHECK(error_of("critical_strain: 0.5, young: 0").find("positive") != std::string::npos);
  CHECK_THROWS_AS(fang("critical_strain: 0.5", {1e-3, 0, 0}), InputError);  // no Young's modulus
}
