// Contact model: how close surfaces become a potential. A scene chooses it by name
// (`contact: {model: ipc}`); all models share the search for close pairs (contact_system.hpp), the
// laws of pairs of objects (pair_table.hpp), friction and bonds.
//
// A model is a specification with parameters. make_potential() makes an instance for a world
// (contact_potential.hpp), which the ContactSystem of the world owns.
#pragma once

#include <memory>

#include "framework/config/registry.hpp"

namespace tack {

class ContactPotential;

/// Base of contact models.
class ContactModel : public Component {
 public:
  static constexpr const char* kind_name = "contact_model";
  static constexpr const char* kind_doc =
      "How close surfaces become a potential: the weights and the form of the sum over close "
      "pairs.";

  /// Makes the potential of a world. The model need not outlive it.
  virtual std::unique_ptr<ContactPotential> make_potential() const = 0;
};

}  // namespace tack
