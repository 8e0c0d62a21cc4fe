// Accounts of friction in histories: they come back as they were stored.
#include "framework/stepping/friction_account.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

using namespace tack;

TEST_CASE("accounts of friction are read as they were stored, bit by bit, with their flags", "[stepping][friction]") {
  FrictionAccounts accounts;
  accounts[{0, 3}] = {0.1, 0.2, 0.3, 0.4, 0.5, true, 0.6, 0.7, 0.8, false};
  accounts[{2, 2}] = {-1e-300, 1e300, 1.0 / 3, 0, 0, false, 5, 6, 7, true};
  accounts[{1, 4}] = {};
  History history;
  history[friction_account_name] = array_of(accounts);
  const FrictionAccounts again = accounts_of(history);
  REQUIRE(again.size() == 3);
  // Equal accounts are stored as equal numbers, and these tell all accounts above apart.
  CHECK(array_of(again).values == array_of(accounts).values);
  for (const auto& [objects, account] : accounts) {
    FrictionAccounts one = {{objects, account}}, other = {{objects, again.at(objects)}};
    CHECK(array_of(one).values == array_of(other).values);
  }
  accounts.begin()->second = {0.1, 0.2, 0.3, 0.4, 0.5, true, 0.6, 0.7, 0.8, true};
  CHECK(array_of(again).values != array_of(accounts).values);
}

TEST_CASE("a history without accounts of friction has none, and one of another width is refused", "[stepping][friction]") {
  History history;
  CHECK(accounts_of(history).empty());
  history[friction_account_name] = array_of({});
  CHECK(accounts_of(history).empty());
  history[friction_account_name] = {3, {1, 2, 3}, {}};
  CHECK_THROWS_AS(accounts_of(history), std::logic_error);
}
