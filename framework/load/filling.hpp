// What fills a chamber: it makes the term that acts on the surface around it.
#pragma once

#include <memory>
#include <string>

#include "framework/config/registry.hpp"
#include "framework/load/volume_term.hpp"

namespace tack {

class Filling : public Component {
 public:
  static constexpr const char* kind_name = "filling";
  static constexpr const char* kind_doc = "Content of a fluid cavity (chamber); exerts pressure on its surface.";

  // surface: closed, of a volume above zero at rest. The filling must outlive the term.
  virtual std::unique_ptr<VolumeTerm> make_term(std::string label, OrientedSurface surface, const VecX& rest) const = 0;
};

// A filling that stores energy, W(V) by the volume at rest and by what has changed since: the amount of it, which is remembered.
class StoredFilling : public Filling {
 public:
  // volume_at_rest: m^3; amount: as a part of what there was at rest; time: s. An infinite energy where there is no such volume.
  virtual VolumeSample at(double volume, double volume_at_rest, double amount, double time) const = 0;
  virtual double target(double volume_at_rest, double time) const = 0;
  // What is left of the amount after a step of size h that ends at that volume [s]; vented: by a rate beside its own [1/s].
  virtual double after(double volume, double volume_at_rest, double amount, double time, double h, double vented) const = 0;
  virtual bool is_gas() const = 0;
  virtual std::vector<double> corners() const { return {}; }  // times at which it changes abruptly [s]
  std::unique_ptr<VolumeTerm> make_term(std::string label, OrientedSurface surface, const VecX& rest) const override;
};

}  // namespace tack
