// Bending of a sheet: the energies of its fans of dihedral edges (fan_stencils.hpp), with a batch
// for each shape of fan. History variables: the whole turns of the angles.
#pragma once

#include "energies/shell/fan_stencils.hpp"
#include "framework/body/body.hpp"
#include "framework/core/strain_spring.hpp"

namespace tack {

class DihedralTerm : public Term, public StrainSpring {
 public:
  // stiffness: D [N m]. rest_angles: true if the rest mesh is free of stress, false if the flat
  // sheet is.
  DihedralTerm(std::string name, const Body& body, const VecX& rest, double stiffness,
               double poisson, bool rest_angles);

  void load_history(const History& history) override;
  void begin_step(const StepStart& start) override;
  void commit(const VecX& x, History& history) const override;

  double value(const VecX& x) const override;
  std::vector<StencilBatch> batches() const override;
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;
  std::vector<const StencilRanges*> ranges() const override;

  // The angles of the dihedral edges of each fan.
  VecX spring_strains(const VecX& x) const override;
  VecX rest_strains() const override;
  void set_rest_strains(const VecX& rest) override;
  double energy_of(const VecX& strains) const override;

 private:
  std::string history_name_;  // of its history array
  std::vector<FanStencils> fans_;
  std::vector<double> turns_;  // of each dihedral edge of each fan
};

}  // namespace tack
