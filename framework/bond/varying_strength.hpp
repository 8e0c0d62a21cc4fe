// Marker of bond laws whose strength varies with time, temperature or age. Peak traction and work
// of adhesion that they state are the largest ones, and a bond that is pulled may have less.
#pragma once

namespace tack {

class VaryingStrength {
 public:
  virtual ~VaryingStrength() = default;
};

}  // namespace tack
