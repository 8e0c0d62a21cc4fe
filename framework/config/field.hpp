// Self-describing parameters. A configurable struct lists each parameter once, beside the member
// that holds its default:
//
//   struct Sphere {
//     double radius = 0.1;  // m
//     void fields(Fields& f) {
//       f.number("radius", radius, units::length, "distance from the centre").positive();
//     }
//   };
//
// Binding a scene file (bind.hpp), documentation, the JSON schema and the echo of the resolved
// scene (describe.hpp) are all written from that list. Fields refer to the members of the object
// they were made from and must not outlive it. Keys are snake_case; `type` is reserved for
// components.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "framework/config/quantity.hpp"
#include "framework/config/registry.hpp"
#include "framework/config/schedule.hpp"
#include "framework/config/shape.hpp"
#include "framework/config/value.hpp"
#include "geometry/types.hpp"

namespace tack {

class Reader;

struct Field {
  std::string key;
  std::string doc;
  Shape shape;
  Bounds bounds;
  bool mandatory = false;
  bool filled = false;  // a list that may not be empty
  bool one_line = false;  // texts without line breaks and other control characters
  std::optional<std::vector<std::string>> variables;  // of a text that is a formula

  // Takes the value over into the member, or reports to the reader why it cannot.
  std::function<void(const Value&, const Field&, Reader&)> read;
  // The member as it is now; null if it is unset.
  std::function<Value()> write;

  // Modifiers, chained behind the declaration. Bounds hold for every number of a list, in SI.
  Field& required();
  Field& nonempty();
  Field& formula(std::vector<std::string> variables);  // a text that is one (formula.hpp), of these and of the scene's parameters
  Field& line();  // a name, say, that tables and messages have within a line
  Field& positive();
  Field& nonnegative();
  Field& range(double low, double high);  // both included
  Field& at_least(double low);
  Field& at_most(double high);
  Field& above(double low);
  Field& below(double high);

  std::string constraint() const;  // "positive", "not empty", ""
};

template <class E>
struct Choice {
  std::string name;
  E value;
  std::string doc;
};

class Fields {
 public:
  Fields() = default;
  Fields(Fields&&) = default;
  Fields& operator=(Fields&&) = default;

  Field& number(std::string key, double& target, Unit unit, std::string doc);
  Field& optional_number(std::string key, std::optional<double>& target, Unit unit,
                         std::string doc);
  // In SI whatever its unit, which is kept to be checked once the dimension is known (Quantity::check).
  Field& optional_quantity(std::string key, std::optional<Quantity>& target, std::string doc);
  // A map of names to such numbers.
  Field& quantities(std::string key, std::map<std::string, Quantity>& target, std::string doc);
  Field& integer(std::string key, int& target, std::string doc);
  Field& optional_integer(std::string key, std::optional<int>& target, std::string doc);
  Field& flag(std::string key, bool& target, std::string doc);
  Field& text(std::string key, std::string& target, std::string doc);
  Field& texts(std::string key, std::vector<std::string>& target, std::string doc);
  Field& numbers(std::string key, std::vector<double>& target, Unit unit, std::string doc);
  Field& vector(std::string key, Vec3& target, Unit unit, std::string doc);
  Field& vector(std::string key, Vec2& target, Unit unit, std::string doc);
  Field& vector(std::string key, std::array<int, 3>& target, std::string doc);
  Field& vector(std::string key, std::array<int, 2>& target, std::string doc);
  Field& vectors(std::string key, std::vector<Vec2>& target, Unit unit, std::string doc);
  Field& optional_vector(std::string key, std::optional<Vec3>& target, Unit unit, std::string doc);
  Field& schedule(std::string key, Schedule& target, Unit unit, std::string doc);

  // Made absolute, relative to the folder of the file it stands in; need not exist. Default: empty.
  Field& path(std::string key, std::string& target, std::string doc);
  Field& paths(std::string key, std::vector<std::string>& target, std::string doc);

  // Kept as written, for later; a path inside it stays unresolved.
  Field& raw(std::string key, Value& target, std::string doc);

  template <class E>
  Field& choice(std::string key, E& target, std::type_identity_t<std::vector<Choice<E>>> options,
                std::string doc);

  // A struct with fields(); a list of them; a map of names to them.
  template <class T>
  Field& object(std::string key, T& target, std::string doc);
  template <class T>
  Field& optional_object(std::string key, std::optional<T>& target, std::string doc);
  template <class T>
  Field& list(std::string key, std::vector<T>& target, std::string doc);
  template <class T>
  Field& map(std::string key, std::map<std::string, T>& target, std::string doc);

  // Pointer: unique_ptr or shared_ptr to a kind's base class, which may be const; null means none. A map without
  // `type` sets fields of the default component, if there is one.
  template <class Pointer>
  Field& component(std::string key, Pointer& target, std::string doc);
  template <class Pointer>
  Field& component_list(std::string key, std::vector<Pointer>& target, std::string doc);

  // A text where a map of these fields is expected is short for a map with this key alone.
  void bare(std::string key) { bare_ = std::move(key); }
  const std::string& bare_key() const { return bare_; }

  // A condition between several fields: returns "" or what is wrong and how to mend it. Runs after
  // all fields of this object were bound without error; reported at `key` if the file has it.
  void check(std::string key, std::function<std::string()> condition);

  struct Check {
    std::string key;
    std::function<std::string()> condition;
  };
  const std::vector<Field>& all() const& { return fields_; }
  const std::vector<Field>& all() && = delete;  // would dangle: for (... : prototype<T>().all())
  const std::vector<Check>& checks() const { return checks_; }
  std::vector<std::string> keys() const;
  const Field* find(std::string_view key) const&;
  const Field* find(std::string_view key) && = delete;

  // Lets the object that these fields refer to live as long as they do.
  void keep(std::shared_ptr<void> owner) { owner_ = std::move(owner); }

 private:
  // Throws std::logic_error for a duplicate or malformed key or a missing doc.
  Field& add(std::string key, std::string doc, Shape shape, decltype(Field::read) read,
             decltype(Field::write) write);
  Field& doubles(std::string key, double* target, int count, Unit unit, std::string doc);
  Field& integers(std::string key, int* target, int count, std::string doc);
  Field& choice_by_index(std::string key, std::string doc, std::vector<Shape::Option> options,
                         std::function<void(std::size_t)> set, std::function<std::size_t()> get);

  std::shared_ptr<void> owner_;
  std::vector<Field> fields_;
  std::vector<Check> checks_;
  std::string bare_;  // empty: no text will do
};

template <class T>
Fields fields_of(T& object) {
  Fields fields;
  object.fields(fields);
  return fields;
}
// To be written out, not read into.
template <class T>
const Fields fields_of(const T& object) {
  return fields_of(const_cast<T&>(object));
}

// The fields of a fresh T, which they keep alive.
template <class T>
Fields prototype() {
  const auto object = std::make_shared<T>();
  Fields fields = fields_of(*object);
  fields.keep(object);
  return fields;
}

// All values as a tree, in SI, each with its unit as comment.
Value to_value(const Fields& fields);
Value to_value(const Component* component);  // with its `type`; null for nullptr

}  // namespace tack

#include "framework/config/field_templates.hpp"
