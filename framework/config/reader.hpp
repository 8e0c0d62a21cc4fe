// Reads values into fields and collects their errors, so that one run reports all errors.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "framework/config/parameters.hpp"
#include "framework/config/units.hpp"
#include "framework/config/value.hpp"

namespace tack {

struct Bounds;
struct Component;
struct Field;
class Fields;
class Kind;
struct Shape;

class Reader {
 public:
  Reader() = default;
  // parameters: names for expressions in place of numbers.
  explicit Reader(Parameters parameters) : parameters_(std::move(parameters)) {}

  // Binds the keys of a map; null counts as an empty map. context: text after "in" in messages,
  // "energy 'arap'".
  void bind(const Value& value, Fields& fields, std::string_view context);

  // Returns the component that `value` names, bound; nullptr after an error. A map without `type`
  // is bound to `present`, if given, and the result is nullptr.
  std::unique_ptr<Component> component(const Value& value, const Kind& kind, Component* present,
                                       std::string_view key);

  // Leaves: set `out` and return true, or report an error and return false. `key` opens the
  // message.
  bool number(const Value& value, const Unit& unit, const Bounds& bounds, std::string_view key,
              double& out);
  bool number(const Value& value, const Field& field, double& out);
  bool integer(const Value& value, const Field& field, int& out);
  bool flag(const Value& value, const Field& field, bool& out);
  bool text(const Value& value, const Field& field, std::string& out);

  // Returns the index of the named option; the number of options after an error.
  std::size_t option(const Value& value, const Field& field);
  // Returns true for a list of the field's length; reports an error otherwise.
  bool list(const Value& value, const Field& field);
  // Reports a value of a form that the field does not accept.
  void unexpected(const Value& value, const Field& field);

  void error(const SourceMark& mark, std::string_view message);
  std::size_t error_count() const { return errors_.size(); }
  // Throws one InputError with all errors, one per line in the order of the file, at most 20.
  void finish() const;

 private:
  struct Error {
    SourceMark mark;
    std::string message;
  };

  void unknown_keys(const Value& map, const Fields& fields, std::string_view context, bool typed);
  void bind_map(const Value& map, Fields& fields, std::string_view context, bool typed);
  void run_checks(const Value& map, const Fields& fields);
  Value with_numbers(const Value& value, const Shape& shape, std::string_view key);
  Value with_numbers_in_formula(const Value& value, const Value& map, const Field& field);

  Parameters parameters_;
  std::vector<Error> errors_;
};

// Returns the name of a list entry for messages: "objects 'desk'", or "objects[2]" without a name.
std::string entry_context(std::string_view key, std::size_t index, const Value& entry);

}  // namespace tack
