// Records of stencils in one list for each arity, the number of their vertices. Loops over a list
// know the arity at compile time. The arities of contact are defined here alone: from 2
// (point-point) to 6 (interior point-triangle).
#pragma once

#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace tack {

inline constexpr int smallest_contact_arity = 2, largest_contact_arity = 6;
// Arities less the smallest one.
using ContactArities =
    std::make_integer_sequence<int, largest_contact_arity - smallest_contact_arity + 1>;
inline constexpr int contact_arity_count = static_cast<int>(ContactArities::size());

template <template <int> class Record>
class ByArity {
 public:
  template <int K>
  std::vector<Record<K>>& of() {
    return std::get<K - smallest_contact_arity>(lists_);
  }
  template <int K>
  const std::vector<Record<K>>& of() const {
    return std::get<K - smallest_contact_arity>(lists_);
  }

 private:
  template <int... I>
  static std::tuple<std::vector<Record<I + smallest_contact_arity>>...> lists(
      std::integer_sequence<int, I...>);
  decltype(lists(ContactArities{})) lists_;
};

// Calls body(list) for each arity, ascending: the order of batches. A body of the form
// [&]<int K>(std::vector<Record<K>>& list) knows the arity K.
template <class Lists, class Body>
void for_each_arity(Lists&& lists, const Body& body) {
  [&]<int... I>(std::integer_sequence<int, I...>) {
    (body(lists.template of<I + smallest_contact_arity>()), ...);
  }
  (ContactArities{});
}

// Calls body(record) for each record of all lists.
template <class Lists, class Body>
void for_each_record(Lists&& lists, const Body& body) {
  for_each_arity(lists, [&](auto& list) {
    for (auto& record : list) body(record);
  });
}

// Calls body.operator()<K>() with K = arity. Throws logic_error for an arity out of range.
template <class Body>
void with_arity(int arity, const Body& body) {
  const bool known = [&]<int... I>(std::integer_sequence<int, I...>) {
    return ((arity == I + smallest_contact_arity &&
             (body.template operator()<I + smallest_contact_arity>(), true)) ||
            ...);
  }
  (ContactArities{});
  if (!known) throw std::logic_error("contact has no stencils of that arity");
}

}  // namespace tack
