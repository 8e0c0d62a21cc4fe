// Bending of a sheet: the energies of its fans of hinges (fan_stencils.hpp), a batch for each of
// their shapes. Turns of angles beyond (-pi, pi] are remembered.
#pragma once

#include "energies/shell/fan_stencils.hpp"
#include "framework/body/body.hpp"

namespace tack {

class HingeTerm : public Term {
 public:
  // stiffness: D [N m]. `rest_angles`: of the sheet as it is at rest; else it wants to be flat.
  HingeTerm(std::string name, const Body& body, const VecX& rest, double stiffness, double poisson,
            bool rest_angles);

  void load_history(const History& history) override;
  void begin_step(const StepStart& start) override;
  void commit(const VecX& x, History& history) const override;

  double value(const VecX& x) const override;
  std::vector<StencilBatch> batches() const override;
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;
  std::vector<const StencilRanges*> ranges() const override;

 private:
  std::string memory_;  // its array in the history
  std::vector<FanStencils> fans_;
  std::vector<double> turns_;  // of each hinge of each fan
};

}  // namespace tack
