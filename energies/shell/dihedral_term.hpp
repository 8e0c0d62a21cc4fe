// Bending of a sheet: the energies of its fans of dihedral edges (fan_stencils.hpp), with a batch
// for each shape of fan. History variables: the whole turns of the angles; of a plastic sheet, the
// plastic angles of each fan and its accumulated plastic curvature.
#pragma once

#include <optional>

#include "energies/shell/fan_stencils.hpp"
#include "framework/body/body.hpp"
#include "framework/core/strain_spring.hpp"

namespace tack {

struct PlasticBending {
  double yield_moment;  // per length, of a sheet curved about one axis [N]
  double hardening;     // growth of the yield moment per plastic curvature [N m]
};

class DihedralTerm : public Term, public StrainSpring {
 public:
  // stiffness: D [N m]. rest_angles: true if the rest mesh is free of stress, false if the flat
  // sheet is. plastic: none for an elastic sheet.
  DihedralTerm(std::string name, const Body& body, const VecX& rest, double stiffness,
               double poisson, bool rest_angles, std::optional<PlasticBending> plastic = {});

  void load_history(const History& history) override;
  void begin_step(const StepStart& start) override;
  void commit(const VecX& x, History& history) const override;

  double value(const VecX& x) const override;
  std::vector<StencilBatch> batches() const override;
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;
  std::vector<const StencilRanges*> ranges() const override;
  void publish(Records& records) const override;

  // The angles of the dihedral edges of each fan.
  VecX spring_strains(const VecX& x) const override;
  VecX rest_strains() const override;
  void set_rest_strains(const VecX& rest) override;
  double energy_of(const VecX& strains) const override;

 private:
  // Yield of a sheet, and its mesh.
  struct Yielding {
    const Body& body;
    const std::vector<SheetTriangle>& sheet;
    const std::vector<DihedralFan>& fans;
    const VecX& rest;
    double stiffness;  // D
    const PlasticBending& plastic;
  };
  void set_yield(const Yielding& y);
  void load_flow(const History& history);
  void commit_flow(const VecX& x, History& history) const;

  std::string history_name_;  // of its history array
  // Plastic sheets only; else empty.
  std::string angles_name_, curvature_name_;
  std::vector<double> plastic_angles_;     // of each dihedral edge of each fan
  std::vector<double> plastic_curvature_;  // of each fan, accumulated [1/m]
  std::vector<double> flow_scale_;         // of each fan: flow per curvature, sqrt(D A) [sqrt(J) m]
  std::vector<FanStencils> fans_;
  std::vector<double> turns_;  // of each dihedral edge of each fan
};

}  // namespace tack
