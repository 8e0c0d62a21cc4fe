// Filling of a chamber. It makes the term that acts on the surface of the chamber.
#pragma once

#include <memory>
#include <string>

#include "framework/config/registry.hpp"
#include "framework/load/volume_term.hpp"

namespace tack {

class Filling : public Component {
 public:
  static constexpr const char* kind_name = "filling";
  static constexpr const char* kind_doc =
      "Content of a fluid cavity (chamber); exerts pressure on its surface.";

  // surface: closed, with a positive volume at rest. The filling must outlive the term.
  virtual std::unique_ptr<VolumeTerm> make_term(std::string label, OrientedSurface surface,
                                                const VecX& rest) const = 0;
};

// Filling with a stored energy W(V), by the volume at rest and by the amount of the content, a
// history variable.
class StoredFilling : public Filling {
 public:
  // volume_at_rest: m^3; amount: fraction of the amount at rest; time: s. The energy is infinite
  // for impossible volumes.
  virtual VolumeSample at(double volume, double volume_at_rest, double amount,
                          double time) const = 0;
  virtual double target(double volume_at_rest, double time) const = 0;
  // Returns the amount after a step of size h [s] that ends at `volume`. vented: leak rate beside
  // that of the filling [1/s].
  virtual double after(double volume, double volume_at_rest, double amount, double time, double h,
                       double vented) const = 0;
  virtual bool is_gas() const = 0;
  // Returns the times of discontinuities [s]
  virtual std::vector<double> corners() const {
    return {};
  }
  std::unique_ptr<VolumeTerm> make_term(std::string label, OrientedSurface surface,
                                        const VecX& rest) const override;
};

}  // namespace tack
