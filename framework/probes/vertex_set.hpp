// Subjects of probes: objects, and selected vertices of one object.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/body/selection.hpp"
#include "framework/config/field.hpp"

namespace tack {

struct World;

/// Returns the index of an object by name. Throws InputError with the nearest name.
int object_index(const World& world, const std::string& name, const std::string& probe);

/// Returns the indices of an object, or with `fill` of all of its copies (NAME_12). Throws
/// InputError with the nearest name.
std::vector<int> copies_of(const World& world, const std::string& name, const std::string& probe);

/// Throws InputError if the scene has no contact.
void require_contact(const World& world, const std::string& probe);

/// `between`: the names of two objects.
class ObjectNames {
 public:
  void fields(Fields& f) {
    f.texts("between", names_, "two object names").required();
    f.check("between", [this]() -> std::string {
      return names_.size() == 2 ? "" : "expects two object names";
    });
  }
  std::pair<int, int> prepare(const World& world, const std::string& probe) const {
    return {object_index(world, names_[0], probe), object_index(world, names_[1], probe)};
  }

 private:
  std::vector<std::string> names_;
};

/// The selected vertices of one object: prepare(), then vertices().
class VertexSet {
 public:
  void fields(Fields& f) {
    f.text("object", object_, "name of the object").required();
    f.component("select", select_, "selected vertices");
  }
  void prepare(const World& world, const std::string& probe);
  const std::vector<int>& vertices() const { return vertices_; }
  Vec3 mean(const VecX& x) const;  ///< mean over the vertices' rows of x

 private:
  std::string object_;
  std::unique_ptr<Selection> select_ = Registry<Selection>::make("all");
  std::vector<int> vertices_;
};

}  // namespace tack
