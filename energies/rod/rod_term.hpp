// Elastic rod (Bergou et al. 2008, 2010): stretching of each edge, bending and twisting of each
// pair of edges that meet (rod_pairs.hpp, bend_twist.hpp),
//     P = sum_e E A / (2 L) (|x_b - x_a| - L)^2
//       + sum_pairs 1 / (2 l) (E I1 (kappa_1 - rest)^2 + E I2 (kappa_2 - rest)^2
//                              + G J (tau - rest)^2).
// The directors of a pair are rotated by half of the twist of the rest mesh each, so that they
// agree at rest. If edges meet at an acute angle, one of them is reversed, so that the angle
// between the tangents is at most a right angle. At a rest angle phi, curvature and twist change by
// more than the relative rotation of the frames: by 1 / cos^2(phi / 2) per angle in the plane of
// phi, by 1 / cos(phi / 2) across it. The strains in P are divided by these factors, so that small
// bending of a corner costs as much as of a straight rod.
#pragma once

#include <memory>

#include "energies/rod/bend_twist.hpp"
#include "energies/rod/edge_stretching.hpp"
#include "energies/rod/rod_pairs.hpp"
#include "framework/core/strain_spring.hpp"
#include "framework/core/strain_view.hpp"

namespace tack {

struct RodMaterial {
  double stretching;  // E A [N]
  Vec3 bending;       // E I1, E I2, G J [N m^2]
};

// Rest shape beside that of the mesh.
struct RodRest {
  bool straight = false;          // of vertices with two edges
  Vec2 curvature = Vec2::Zero();  // of those vertices, added to that of the mesh [1/m]
  double twist = 0;               // 1/m
};

class RodTerm : public Term, public ResidualView, public StrainView, public StrainSpring {
 public:
  // frames: of these edges, perhaps among others. history_name: prefix of its history arrays.
  RodTerm(std::string name, std::string history_name, const RodMaterial& material,
          const RodRest& shape, std::vector<Edge> edges, std::shared_ptr<const RodFrames> frames,
          const VecX& rest);

  void load_history(const History& history) override;
  void commit(const VecX& x, History& history) const override;

  double value(const VecX& x) const override { return value_of(x, nullptr); }
  std::vector<StencilBatch> batches() const override;
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override {
    derivatives_of(x, nullptr, projection, gradient, hessian);
  }

  // The lengths of the edges, then three strains of each pair.
  VecX strains(const VecX& x) const override;
  double value_from(const VecX& x, const VecX& rest) const override {
    return value_of(x, rest.data());
  }
  void derivatives_from(const VecX& x, const VecX& rest, Projection projection, double* gradient,
                        double* hessian) const override {
    derivatives_of(x, rest.data(), projection, gradient, hessian);
  }

  // In the order of strains().
  VecX spring_strains(const VecX& x) const override { return strains(x); }
  VecX rest_strains() const override;
  void set_rest_strains(const VecX& rest) override;
  double energy_of(const VecX& strains) const override;

  // Stretches, and three strains of each pair.
  const ResidualView* residual_view() const override { return this; }
  std::vector<ResidualBatch> residual_batches() const override;
  bool residuals(const VecX& x, double* r, double* jacobian) const override;

 private:
  using Chain = Eigen::Matrix<double, 8, 15>;
  // Vertices a, v, b of a path along two edges, and their twists.
  struct Pair {
    std::array<int, 2> edge;        // in the frames
    std::array<bool, 2> backwards;  // against the direction in which it is stored
    bool second_from_end;           // true: the second edge leads from b to v
    std::array<double, 2> turned;   // rotation of the directors [rad]
    Mat3 root;                      // of the stiffness C = root^T root (see BendTwist) [J^1/2]
    Vec3 rest;                      // strains at rest (see BendTwist)
  };
  int pair_count() const { return static_cast<int>(pairs_.size()); }
  // strains: reference strains; null: those at rest.
  double value_of(const VecX& x, const double* strains) const;
  void derivatives_of(const VecX& x, const double* strains, Projection projection, double* gradient,
                      double* hessian) const;
  Vec3 rest_of(int pair, const double* strains) const {
    return strains ? Vec3(Eigen::Map<const Vec3>(strains + stretching_.count() +
                                                 3 * static_cast<size_t>(pair)))
                   : pairs_[pair].rest;
  }
  Quaternion frame(const Pair& pair, int side) const;
  double sign(const Pair& pair, int side) const { return pair.backwards[side] ? -1 : 1; }
  void settle(Pair& pair, const RodPair& of, const RodMaterial& material, const RodRest& shape,
              const VecX& rest);
  BendTwist::EdgePair edge_pair(int pair, const VecX& x) const;
  Chain chain(int pair) const;

  std::string history_name_;
  std::shared_ptr<const RodFrames> frames_;
  EdgeStretching stretching_;
  std::vector<Pair> pairs_;
  std::vector<std::array<int, 5>> stencils_;
  // Data of the committed frames:
  std::vector<BendTwist> bends_;
  std::vector<std::array<Mat3, 2>> axes_;  // of both frames, as rows
  std::vector<double> turns_;              // BendTwist::EdgePair::turn
};

}  // namespace tack
