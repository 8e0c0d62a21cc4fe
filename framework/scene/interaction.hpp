// What acts between objects, on vertices that are chosen of them, or on one: an entry of `interactions:`. It is turned into terms of the
// potential (core/term.hpp), with unknowns of its own and vertices that follow others, by a builder (interaction_builder.hpp).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/body/selection.hpp"
#include "framework/config/field.hpp"

namespace tack {

class InteractionBuilder;

// Vertices of an object, as a value of a scene: {object: NAME, select: {...}}.
struct ObjectVertices {
  std::string object;
  std::unique_ptr<Selection> select = Registry<Selection>::make("all");
  void fields(Fields& f);
};

class Interaction : public Component {
 public:
  static constexpr const char* kind_name = "interaction";
  static constexpr const char* kind_doc = "A connection between objects or vertices, or an action on one object: joints, springs, ropes, fluid "
                                          "cavities.";

  // What derives from it lists its own behind these.
  void fields(Fields& f) override;
  const std::string& given_name() const { return name_; }  // "": none is given

  // On which it acts, by name, or by that of a group; "*": all.
  virtual std::vector<std::string> objects() const = 0;
  // Whether these stay where the scene puts them: contact.push_out moves none of them then.
  virtual bool places() const { return true; }
  // Asks the builder for all that it consists of. Throws InputError, to which its place in the file is added.
  virtual void build(InteractionBuilder& builder) const = 0;

 private:
  std::string name_;
};

}  // namespace tack
