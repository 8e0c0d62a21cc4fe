// A statistic of a probe, as in a file: {probe: force, statistic: at, along: gap, where: 1 mm},
// {probe: force, statistic: deviation, along: opening, follows: {file: load.csv}}.
#pragma once

#include <optional>

#include "framework/config/field.hpp"
#include "framework/output/statistic.hpp"

namespace tack {

struct SpecifiedStatistic {
  StatisticQuery query;
  std::optional<Quantity> where;

  void fields(Fields& f);
  StatisticQuery resolved() const;  // the query with `where` in SI
};

}  // namespace tack
