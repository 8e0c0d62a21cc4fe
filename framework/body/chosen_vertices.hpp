// Marks of chosen vertices of an object, for queries by its elements.
#pragma once

#include <algorithm>
#include <vector>

#include "framework/body/body.hpp"

namespace tack {

class ChosenVertices {
 public:
  // vertices: global, of the body.
  ChosenVertices(const Body& body, const std::vector<int>& vertices)
      : first_(body.first_vertex), chosen_(static_cast<size_t>(body.vertex_count), 0) {
    for (const int v : vertices) chosen_[v - first_] = 1;
  }
  bool has(int v) const { return chosen_[v - first_] != 0; }
  // Returns true if all vertices of an element are chosen.
  template <class Element>
  bool contains(const Element& element) const {
    return std::all_of(element.begin(), element.end(), [this](int v) { return has(v); });
  }

 private:
  int first_;
  std::vector<char> chosen_;
};

}  // namespace tack
