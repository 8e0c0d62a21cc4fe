// A statistic of a probe, as in a file: {probe: force, statistic: at, along: gap, where: 1 mm},
// {probe: force, statistic: deviation, along: opening, follows: {file: load.csv}},
// {probe: force, statistic: max, stage: retract}.
#pragma once

#include <optional>

#include "framework/config/field.hpp"
#include "framework/output/stages_csv.hpp"
#include "framework/output/statistic.hpp"

namespace tack {

struct SpecifiedStatistic {
  StatisticQuery query;
  std::optional<Quantity> where;
  std::string stage;  // of a protocol: samples in that stage alone; empty: of the whole run

  void fields(Fields& f);
  StatisticQuery resolved() const;  // the query with `where` in SI
  // Returns "force: max in stage retract".
  std::string description() const;
  // Returns the windows of its stage; nullopt without one. visits: the run's stages.
  TimeWindows windows(const std::vector<StageVisit>& visits) const;
  // Returns its value for a run. visits: the run's stages. Throws InputError as evaluate does.
  StatisticValue value(const ProbeSeries& series, const std::vector<StageVisit>& visits) const;
};

}  // namespace tack
