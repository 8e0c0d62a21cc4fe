// Content of a fluid cavity. It makes the term that acts on the surface of the cavity.
#pragma once

#include <memory>
#include <string>

#include "framework/config/registry.hpp"
#include "framework/load/volume_term.hpp"

namespace tack {

class CavityContent : public Component {
 public:
  static constexpr const char* kind_name = "filling";
  static constexpr const char* kind_doc =
      "Content of a fluid cavity (chamber); exerts pressure on its surface.";

  // surface: closed, with a positive volume at rest. The content must outlive the term.
  virtual std::unique_ptr<VolumeTerm> make_term(std::string label, OrientedSurface surface,
                                                const VecX& rest) const = 0;
};

// Content with a stored energy W(V). W also depends on the volume at rest and on the amount of
// content, a history variable.
class StoredContent : public CavityContent {
 public:
  // Returns the stored energy and its derivatives; the energy is infinite for impossible volumes.
  // volume_at_rest: m^3; amount: fraction of the amount at rest; time: s.
  virtual VolumeSample at(double volume, double volume_at_rest, double amount,
                          double time) const = 0;
  // Returns the target volume [m^3]; NaN without one.
  virtual double target(double volume_at_rest, double time) const = 0;
  // Returns the amount after a step of size h [s] that ends at `volume`. leak: leak rate in
  // addition to that of the content [1/s].
  virtual double after(double volume, double volume_at_rest, double amount, double time, double h,
                       double leak) const = 0;
  virtual bool is_gas() const = 0;
  // Returns the times of discontinuities [s].
  virtual std::vector<double> corners() const { return {}; }
  std::unique_ptr<VolumeTerm> make_term(std::string label, OrientedSurface surface,
                                        const VecX& rest) const override;
};

}  // namespace tack
