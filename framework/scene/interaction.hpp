// An interaction between objects, on selected vertices, or on one object: an entry of
// `interactions:`. A builder (interaction_builder.hpp) turns it into terms of the potential
// (core/term.hpp), with unknowns of its own and dependent vertices.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/body/selection.hpp"
#include "framework/config/field.hpp"

namespace tack {

class InteractionBuilder;

/// Vertices of an object, as a scene value: {object: NAME, select: {...}}.
struct ObjectVertices {
  std::string object;
  std::unique_ptr<Selection> select = Registry<Selection>::make("all");
  void fields(Fields& f);
};

/// Base of interactions, which implement objects() and build().
class Interaction : public Component {
 public:
  static constexpr const char* kind_name = "interaction";
  static constexpr const char* kind_doc =
      "A connection between objects or vertices, or an action on one object: joints, springs, "
      "ropes, fluid cavities.";

  /// Derived classes append their fields to these.
  void fields(Fields& f) override;
  const std::string& given_name() const { return name_; }  // "": none was given

  /// Names of the objects or groups that it acts on; "*": all.
  virtual std::vector<std::string> objects() const = 0;
  /// Returns true if these objects keep their placement, so that
  /// contact.overclosure_adjustment does not move them.
  virtual bool keeps_placement() const { return true; }
  /// Requests all parts of the interaction from the builder. Throws InputError; the caller adds the
  /// source location.
  virtual void build(InteractionBuilder& builder) const = 0;

 private:
  std::string name_;
};

}  // namespace tack
