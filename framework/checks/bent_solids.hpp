// Warnings about slender bodies of few linear tets across, which resist bending too much. A bar
// with 1, 2, 4, 8 cells over its thickness bends by this fraction of the exact deflection:
//     Poisson's ratio 0.3    0.22, 0.50, 0.79, 0.93
//     Poisson's ratio 0.49   0.04, 0.10, 0.29, 0.58
// Composite tets (Elements) do not lock. Only the run shows whether a body bends: over a patch that
// is a few thicknesses wide, the strain of bending has zero mean, that of stretching, shearing and
// compression is its mean. The fraction of bending is the mean square strain less the squared means
// of the patches.
#pragma once

#include <string>
#include <vector>

#include "framework/core/warning.hpp"
#include "geometry/types.hpp"

namespace tack {

struct Body;
struct SceneConfig;
struct World;

class SlenderSolid {
 public:
  SlenderSolid(int number, const Body& of, const VecX& rest, double across, int most_cells);

  // Examines the strain at x (3n).
  void examine(const VecX& x);
  // Returns the largest bending part of the mean square strain, over the sum of this part and the
  // largest remaining part; 0 if there is hardly any strain.
  double bending_fraction() const;

  int body;          // of the world
  double thickness;  // 2 V / A [m]
  int cells;         // over it, at most

 private:
  void make_patches(const VecX& rest);

  std::vector<Tet> tets_;
  std::vector<Mat3> from_rest_;  // per tet: the inverse of its edges at rest [1/m]
  std::vector<double> volume_;   // per tet [m^3]
  std::vector<int> patch_;       // per tet
  int patches_ = 0;
  double stretched_ = 0, bent_ = 0;  // the largest mean squares so far
};

class BentSolids {
 public:
  BentSolids(const SceneConfig& scene, const World& world);

  // Returns a line for each slender body: before a run it is not known whether the body bends.
  std::vector<std::string> notes() const;
  // Examines the strain at x (3n); called after every step.
  void examine(const VecX& x);
  // Returns a warning for each body that was strained by bending. Called at the end, because
  // vibrating bodies bend as well.
  std::vector<Warning> warnings() const;

 private:
  const SceneConfig& scene_;
  const World& world_;
  std::vector<SlenderSolid> solids_;
};

}  // namespace tack
