// Form of a parameter, as data, so that error messages, documentation and the JSON schema need not
// know its C++ type.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/units.hpp"

namespace tack {

class Fields;
class Kind;

struct Shape {
  enum class Form {
    number,
    integer,
    flag,
    text,
    path,
    choice,
    schedule,
    list,
    map,
    object,
    component,
    any
  };
  struct Option {
    std::string name;
    std::string doc;
  };

  Form form = Form::any;
  Unit unit = units::none;             // number, schedule, and lists of numbers
  bool nullable = false;               // null means unset
  int count = -1;                      // list: its fixed length, -1 for any
  std::shared_ptr<const Shape> entry;  // list, map: shape of each entry
  std::vector<Option> options;         // choice
  std::function<Fields()> prototype;   // object: the fields of a default instance
  const Kind* kind = nullptr;          // component

  std::string noun() const;         // "pressure (Pa)", "list of 3 lengths (m)", "map"
  std::string expectation() const;  // the noun with its article, or "true or false"
};

// simple_shape: a shape without further attributes. list_shape: count -1 for any length.
Shape simple_shape(Shape::Form form, Unit unit = units::none);
Shape list_shape(Shape entry, int count = -1);

// Permitted values of a number. Text: "positive", "in [0, 1]", "at least 1", "above -1 and below
// 0.5".
struct Bounds {
  std::optional<double> low;
  std::optional<double> high;
  bool low_open = false;  // low itself is excluded
  bool high_open = false;

  bool contains(double value) const;
  std::string text() const;  // "" without bounds
};

}  // namespace tack
