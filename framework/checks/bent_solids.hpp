// Slender bodies of few linear tets across, which resist bending too much: with 1, 2, 4, 8 cells over its thickness a bar bends by
// 0.22, 0.50, 0.79, 0.93 of what it should at a Poisson's ratio of 0.3, by 0.04, 0.10, 0.29, 0.58 at 0.49; composite tets (Elements) do not. Whether a body bends
// shows in the run: over a patch that is some thicknesses wide, the strain of bending has no mean, that of stretching, shearing or
// pressing all of it is its mean. What is left of the mean square without the squares of the means of patches is the share of bending.
#pragma once

#include <string>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct Body;
struct SceneConfig;
struct World;

class SlenderSolid {
 public:
  SlenderSolid(int number, const Body& of, const VecX& rest, double across, int most_cells);

  // At x (3n).
  void look(const VecX& x);
  // The largest mean square of strain that had no mean, of the sum of this and the largest that had; 0 if hardly anything strained it.
  double share_of_bending() const;

  int body;          // of the world
  double thickness;  // 2 V / A [m]
  int cells;         // over it, at most

 private:
  void make_patches(const VecX& rest);

  std::vector<Tet> tets_;
  std::vector<Mat3> from_rest_;  // per tet: the inverse of its edges at rest [1/m]
  std::vector<double> volume_;   // likewise [m^3]
  std::vector<int> patch_;       // likewise
  int patches_ = 0;
  double stretched_ = 0, bent_ = 0;  // the largest mean squares so far
};

class BentSolids {
 public:
  BentSolids(const SceneConfig& scene, const World& world);

  // What to expect of those that there are, a line each: before a run it is not known whether they bend.
  std::vector<std::string> expected() const;
  // At x (3n), after every step.
  void look(const VecX& x);
  // Of those whose strain was bending, a warning each: once all is seen, because whatever vibrates bends as well.
  std::vector<std::string> bent() const;

 private:
  const SceneConfig& scene_;
  const World& world_;
  std::vector<SlenderSolid> solids_;
};

}  // namespace tack
