#include "framework/contact/stencils/by_arity.hpp"

#include <catch2/catch.hpp>

using namespace tack;

namespace {

template <int K>
struct Numbered {
  int number;
};

}  // namespace

TEST_CASE("lists by arity: all of them, ascending", "[contact]") {
  ByArity<Numbered> lists;
  for (const int arity : {6, 2, 4, 3, 4, 5})
    with_arity(arity, [&]<int K>() { lists.of<K>().push_back({10 * arity + static_cast<int>(lists.of<K>().size())}); });
  std::vector<int> arities, numbers;
  for_each_arity(lists, [&]<int K>(const std::vector<Numbered<K>>&) { arities.push_back(K); });
  for_each_record(lists, [](auto& n) { n.number *= 2; });
  for_each_record(lists, [&](const auto& n) { numbers.push_back(n.number); });
  CHECK(arities == std::vector{2, 3, 4, 5, 6});
  CHECK(static_cast<int>(arities.size()) == contact_arity_count);
  CHECK(numbers == std::vector{40, 60, 80, 82, 100, 120});
}

TEST_CASE("lists by arity: arities that contact does not have are refused", "[contact]") {
  for (const int arity : {1, 7}) CHECK_THROWS(with_arity(arity, []<int K>() {}));
}
