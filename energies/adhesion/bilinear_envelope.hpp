// Bilinear envelope: the traction rises to sigma = K d_0 at the onset d_0 and falls to 0 at
// d_f = 2 W / sigma. Damage: D = d_f (x - d_0) / (x (d_f - d_0)).
#pragma once

namespace tack {

struct BilinearEnvelope {
  double work, onset, last;  // J/m^2, m, m

  double end() const { return last; }
  double damage(double x) const {
    return x > onset ? last * (x - onset) / (x * (last - onset)) : 0;
  }
  double growth(double x) const { return last * onset / (x * x * (last - onset)); }
  double opening(double damage) const { return onset * last / (last - damage * (last - onset)); }
  double spent(double damage) const {
    return work * onset * damage / (last - damage * (last - onset));
  }
};

}  // namespace tack
