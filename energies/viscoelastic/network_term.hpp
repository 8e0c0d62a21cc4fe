// Terms of a nonequilibrium network (bergstrom_boyce.hpp): of linear tets and tets with patches,
// and of composite tets.
#pragma once

#include "energies/solid/composite_term.hpp"
#include "energies/solid/solid_term.hpp"
#include "energies/viscoelastic/bergstrom_boyce.hpp"
#include "energies/viscoelastic/network_history.hpp"
#include "energies/viscoelastic/shifted_times.hpp"

namespace tack {

class NetworkTets : public SolidTerm<BergstromBoyce> {
 public:
  NetworkTets(std::string name, const NetworkFlow& flow, const TemperatureShift& shift,
              const Body& body, const VecX& rest);

  void load_history(const History& history) override;
  void begin_step(const StepStart& start) override;
  void commit(const VecX& x, History& history) const override;
  void publish(Records& records) const override;
  double dissipated(const VecX& x) const;  // of a step to x [J]

 private:
  void set_log_factors();

  NetworkHistory history_;
  ShiftedTimes times_;
  std::vector<TetRest<Pack>> rest_shapes_;  // without viscous flow; rest_ includes it
  VecX start_;                              // of the step (3n) [m]
};

class CompositeNetwork : public CompositeTerm<BergstromBoyce> {
 public:
  CompositeNetwork(std::string name, const NetworkFlow& flow, const TemperatureShift& shift,
                   const Body& body, const VecX& rest);

  void load_history(const History& history) override;
  void begin_step(const StepStart& start) override;
  void commit(const VecX& x, History& history) const override;
  void publish(Records& records) const override;
  double dissipated(const VecX& x) const;  // of a step to x [J]

 private:
  void set_log_factors();

  NetworkHistory history_;
  ShiftedTimes times_;
  VecX start_;  // of the step (3n) [m]
};

}  // namespace tack
