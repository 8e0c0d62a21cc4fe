// Cursor over a sorted list: it finds the keys that the list has, and no others.
#include "framework/contact/stencils/sorted_cursor.hpp"

#include <catch2/catch.hpp>
#include <random>
#include <set>

using namespace tack;

namespace {

struct Entry {
  std::array<int, 2> at;
  std::array<int, 2> key() const { return at; }
};

}  // namespace

TEST_CASE("a sorted cursor finds ascending keys, wherever it starts, against brute force", "[contact][cursor]") {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> number(0, 20);
  for (int trial = 0; trial < 200; ++trial) {
    std::set<std::array<int, 2>> keys, asked;
    for (int i = number(random); i > 0; --i) keys.insert({number(random), number(random)});
    for (int i = number(random); i > 0; --i) asked.insert({number(random), number(random)});
    asked.insert(keys.begin(), keys.end());
    std::vector<Entry> list;
    for (const auto& k : keys) list.push_back({k});
    SortedCursor<Entry> cursor(list);
    for (const auto& k : asked) {
      if (k[0] < trial % 10) continue;
      const Entry* found = cursor.find(k);
      CHECK((found != nullptr) == (keys.count(k) == 1));
      if (found) CHECK(found->at == k);
      CHECK(cursor.find(k) == found);  // a key may be asked for again
    }
  }
}

TEST_CASE("a sorted cursor over an empty list finds nothing", "[contact][cursor]") {
  const std::vector<Entry> list;
  SortedCursor<Entry> cursor(list);
  CHECK(cursor.find({0, 0}) == nullptr);
  CHECK(cursor.find({1 << 30, 1 << 30}) == nullptr);
}
