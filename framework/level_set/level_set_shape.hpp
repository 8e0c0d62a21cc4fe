// The surface of a level set, as the mesh of an object.
#pragma once

#include "framework/level_set/level_set.hpp"
#include "framework/shapes/shape_source.hpp"

namespace tack {

class LevelSetShape : public ShapeSource {
 public:
  void fields(Fields& f) override;
  bool costly() const override { return true; }
  Mesh make() const override;

 private:
  std::unique_ptr<LevelSet> of_;
  double voxel_ = 0;  // m
};

}  // namespace tack
