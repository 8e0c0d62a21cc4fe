// Self-describing parameters. A configurable struct lists each parameter once, beside the member
// that holds its default:
//
//    struct Sphere {
//      double radius = 0.1;  // m
//      void fields(Fields& f) {
//        f.number("radius", radius, units::length, "distance from the centre").positive();
//      }
//    };
//
// Scene binding (bind.hpp), documentation, the JSON schema and the echo of the resolved scene
// (describe.hpp) are generated from that list. Fields refer to members of the object they were
// made from and must not outlive it. Keys are snake_case; `type` is reserved for components.
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

/// A parameter: its key, doc, shape and bounds, with access to the member that holds it.
struct Field {
  std::string key;
  std::string doc;
  Shape shape;
  Bounds bounds;
  bool mandatory = false;
  bool filled = false;    ///< a list must not be empty
  bool one_line = false;  ///< a text must not have line breaks or other control characters
  std::optional<std::vector<std::string>> variables;  ///< of a text that is a formula
  std::string instead;  ///< of a deprecated field: what to write instead; empty: not deprecated

  /// Stores the value in the member, or reports to the reader why it cannot.
  std::function<void(const Value&, const Field&, Reader&)> read;
  /// Returns the member's present value; null if it is unset.
  std::function<Value()> write;

  /// Modifiers, chained to the declaration. Bounds hold for every number of a list, in SI.
  Field& required();
  Field& nonempty();
  /// Declares a formula (formula.hpp) of these variables and the scene's parameters.
  Field& formula(std::vector<std::string> variables);
  /// Declares a deprecated field: accepted with a warning that says what to write instead, and
  /// left out of written scenes. Another field holds its meaning.
  Field& deprecated(std::string instead);
  Field& line();  ///< a text within one line, such as a name in tables and messages
  Field& positive();
  Field& nonnegative();
  Field& range(double low, double high);  ///< both ends included
  Field& at_least(double low);
  Field& at_most(double high);
  Field& above(double low);
  Field& below(double high);

  std::string constraint() const;  ///< "positive", "not empty", ""
};

/// An option of a choice: its name in scene files, its value and its doc.
template <class E>
struct Choice {
  std::string name;
  E value;
  std::string doc;
};

/// The list of an object's parameters. Each declaration adds a field and returns it for modifiers.
class Fields {
 public:
  Fields() = default;
  Fields(Fields&&) = default;
  Fields& operator=(Fields&&) = default;

  Field& number(std::string key, double& target, Unit unit, std::string doc);
  Field& optional_number(std::string key, std::optional<double>& target, Unit unit,
                         std::string doc);
  /// Number in SI with its unit as written, checked once the dimension is known (Quantity::check).
  Field& optional_quantity(std::string key, std::optional<Quantity>& target, std::string doc);
  /// Map of names to optional_quantity() numbers.
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

  /// Path, made absolute relative to the folder of its file; need not exist. Default: empty.
  Field& path(std::string key, std::string& target, std::string doc);
  Field& paths(std::string key, std::vector<std::string>& target, std::string doc);

  /// Value kept as written; paths inside it stay unresolved.
  Field& raw(std::string key, Value& target, std::string doc);

  template <class E>
  Field& choice(std::string key, E& target, std::type_identity_t<std::vector<Choice<E>>> options,
                std::string doc);

  /// object: a struct with fields(). list: a list of structs. map: a map of names to structs.
  template <class T>
  Field& object(std::string key, T& target, std::string doc);
  template <class T>
  Field& optional_object(std::string key, std::optional<T>& target, std::string doc);
  template <class T>
  Field& list(std::string key, std::vector<T>& target, std::string doc);
  template <class T>
  Field& map(std::string key, std::map<std::string, T>& target, std::string doc);

  /// Component of a kind. Pointer: unique_ptr or shared_ptr to the kind's base class, which may be
  /// const; null means none. A map without `type` sets fields of the default component, if there
  /// is one.
  template <class Pointer>
  Field& component(std::string key, Pointer& target, std::string doc);
  template <class Pointer>
  Field& component_list(std::string key, std::vector<Pointer>& target, std::string doc);

  /// Sets the key that a text stands for where a map of these fields is expected.
  void bare(std::string key) { bare_ = std::move(key); }
  const std::string& bare_key() const { return bare_; }

  /// Adds a condition between several fields: it returns "" or the error and its remedy. Runs
  /// after all fields of this object were bound without error. Errors are reported at `key` if the
  /// file has it.
  void check(std::string key, std::function<std::string()> condition);

  struct Check {
    std::string key;
    std::function<std::string()> condition;
  };
  const std::vector<Field>& all() const& { return fields_; }
  const std::vector<Field>& all() && = delete;  ///< would dangle: for (... : prototype<T>().all())
  const std::vector<Check>& checks() const { return checks_; }
  std::vector<std::string> keys() const;
  const Field* find(std::string_view key) const&;
  const Field* find(std::string_view key) && = delete;

  /// Keeps the object that these fields refer to alive as long as the fields.
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
  std::string bare_;  // empty: a text is an error
};

/// Returns the fields of `object`, which must outlive them.
template <class T>
Fields fields_of(T& object) {
  Fields fields;
  object.fields(fields);
  return fields;
}
/// Returns the fields of a const object, for writing out only.
template <class T>
const Fields fields_of(const T& object) {
  return fields_of(const_cast<T&>(object));
}

/// Returns the fields of a new T, which they keep alive.
template <class T>
Fields prototype() {
  const auto object = std::make_shared<T>();
  Fields fields = fields_of(*object);
  fields.keep(object);
  return fields;
}

/// Returns all values as a tree, in SI, each with its unit as comment.
Value to_value(const Fields& fields);
Value to_value(const Component* component);  // with its `type`; null for nullptr

}  // namespace tack

#include "framework/config/field_templates.hpp"
