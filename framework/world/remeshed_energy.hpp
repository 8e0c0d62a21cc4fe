// Energy lost by remeshing between two steps, in the account of the following step.
#pragma once

#include <string>

#include "framework/core/history.hpp"
#include "framework/core/records.hpp"
#include "framework/core/step_participant.hpp"

namespace tack {

class RemeshedEnergy : public StepParticipant {
 public:
  // History array: energy lost since the last step [J].
  static constexpr const char* name = "remeshing/lost";

  void load_history(const History& history) override {
    const auto* lost = history_values(history, name, 1, 1);
    lost_ = lost ? lost->front() : 0;
  }
  void commit(const VecX&, History& history) const override { history.erase(name); }

  void publish(Records& records) const {
    records.add(FlowRecord{"remeshing",
                           {{"dissipated_remeshing"}},
                           [this](const VecX&, double* amounts) { amounts[0] = lost_; }});
  }

 private:
  double lost_ = 0;  // J
};

}  // namespace tack
