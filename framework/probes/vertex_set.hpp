// The vertices of an object that a probe looks at.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/config/field.hpp"
#include "framework/scene/selection.hpp"

namespace tack {

struct World;

// The index of an object by name; throws InputError with the nearest name.
int object_index(const World& world, const std::string& name, const std::string& probe);

class VertexSet {
 public:
  void fields(Fields& f) {
    f.text("object", object_, "name of the object").required();
    f.component("select", select_, "its vertices");
  }
  void prepare(const World& world, const std::string& probe);
  const std::vector<int>& vertices() const { return vertices_; }
  Vec3 mean(const VecX& x) const;  // of the vertices' rows of x

 private:
  std::string object_;
  std::unique_ptr<Selection> select_ = Registry<Selection>::make("all");
  std::vector<int> vertices_;
};

}  // namespace tack
