// The plain kinds of fields: numbers, texts, vectors, choices, schedules.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "framework/config/field.hpp"
#include "framework/config/parse.hpp"
#include "framework/config/reader.hpp"
#include "framework/config/words.hpp"
#include "framework/config/written_number.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

using Form = Shape::Form;

void require_finite(const std::string& key, double value) {
  if (std::isfinite(value)) return;
  throw std::logic_error(fmt::format("'{}' is not finite; make it optional instead", key));
}

Shape nullable(Shape shape) {
  shape.nullable = true;
  return shape;
}

void read_schedule(const Value& v, const Field& field, Reader& reader, Schedule& target) {
  double constant = 0;
  if (v.is_scalar() && reader.number(v, field, constant)) target = Schedule(constant);
  if (v.is_scalar()) return;
  if (!v.is_sequence()) return reader.unexpected(v, field);
  std::vector<Schedule::Point> points;
  for (const Value& pair : v.items) {
    Schedule::Point p{};
    if (!pair.is_sequence() || pair.items.size() != 2) {
      return reader.error(pair.mark, fmt::format("{}: expects [time, {}] pairs, got {}", field.key,
                                                 field.shape.unit.quantity, pair.description()));
    }
    const bool ok = reader.number(pair.items[0], units::time, {}, field.key, p.time);
    if (!reader.number(pair.items[1], field, p.value) || !ok) return;
    points.push_back(p);
  }
  try {
    target = Schedule(std::move(points));
  } catch (const InputError& e) {
    reader.error(v.mark, fmt::format("{}: {}", field.key, e.what()));
  }
}

Value write_schedule(const Schedule& schedule) {
  if (schedule.constant()) return Value::number(schedule.points().front().value);
  Value pairs = Value::sequence();
  for (const Schedule::Point& p : schedule.points()) {
    pairs.items.push_back(Value::sequence({Value::number(p.time), Value::number(p.value)}));
  }
  return pairs;
}

Value write_texts(const std::vector<std::string>& texts) {
  Value list = Value::sequence();
  for (const std::string& text : texts) list.items.push_back(Value::scalar(text));
  return list;
}

void read_doubles(const Value& v, const Field& field, Reader& reader, double* target) {
  if (!reader.list(v, field)) return;
  for (const Value& item : v.items) reader.number(item, field, *target++);
}

Value write_doubles(const double* data, std::size_t count) {
  Value list = Value::sequence();
  for (std::size_t i = 0; i < count; ++i) list.items.push_back(Value::number(data[i]));
  return list;
}

}  // namespace

Field& Fields::number(std::string key, double& target, Unit unit, std::string doc) {
  require_finite(key, target);
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    reader.number(v, field, target);
  };
  const auto write = [&target] { return Value::number(target); };
  return add(std::move(key), std::move(doc), simple_shape(Form::number, unit), read, write);
}

Field& Fields::optional_number(std::string key, std::optional<double>& target, Unit unit,
                               std::string doc) {
  if (target) require_finite(key, *target);
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    if (v.is_null()) return target.reset();
    double number = 0;
    if (reader.number(v, field, number)) target = number;
  };
  const auto write = [&target] { return target ? Value::number(*target) : Value(); };
  return add(std::move(key), std::move(doc), nullable(simple_shape(Form::number, unit)), read,
             write);
}

Field& Fields::optional_quantity(std::string key, std::optional<Quantity>& target, std::string doc) {
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    if (v.is_null()) return target.reset();
    double number = 0;
    if (reader.number(v, field, number)) target = Quantity{number, v.text};
  };
  const auto write = [&target] { return target ? Value::number(target->si) : Value(); };
  return add(std::move(key), std::move(doc), nullable(simple_shape(Form::number, units::any)), read, write);
}

Field& Fields::quantities(std::string key, std::map<std::string, Quantity>& target, std::string doc) {
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    if (!v.is_map()) return reader.unexpected(v, field);
    target.clear();
    for (const Value::Entry& e : v.entries) {
      double number = 0;
      if (reader.number(e.value, units::any, field.bounds, field.key + " '" + e.key + "'", number)) target[e.key] = {number, e.value.text};
    }
  };
  const auto write = [&target] {
    Value named = Value::map();
    for (const auto& [name, quantity] : target) {
      Value& value = named.set(name, Value::number(quantity.si));
      if (const std::optional<WrittenNumber> written = written_number(quantity.written)) value.comment = written->unit;
    }
    return named;
  };
  Shape shape = list_shape(simple_shape(Form::number, units::any));
  shape.form = Form::map;
  return add(std::move(key), std::move(doc), std::move(shape), read, write);
}

Field& Fields::integer(std::string key, int& target, std::string doc) {
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    reader.integer(v, field, target);
  };
  const auto write = [&target] { return Value::scalar(std::to_string(target)); };
  return add(std::move(key), std::move(doc), simple_shape(Form::integer), read, write);
}

Field& Fields::optional_integer(std::string key, std::optional<int>& target, std::string doc) {
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    if (v.is_null()) return target.reset();
    int number = 0;
    if (reader.integer(v, field, number)) target = number;
  };
  const auto write = [&target] {
    return target ? Value::scalar(std::to_string(*target)) : Value();
  };
  return add(std::move(key), std::move(doc), nullable(simple_shape(Form::integer)), read, write);
}

Field& Fields::flag(std::string key, bool& target, std::string doc) {
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    reader.flag(v, field, target);
  };
  const auto write = [&target] { return Value::scalar(target ? "true" : "false"); };
  return add(std::move(key), std::move(doc), simple_shape(Form::flag), read, write);
}

Field& Fields::text(std::string key, std::string& target, std::string doc) {
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    reader.text(v, field, target);
  };
  const auto write = [&target] { return Value::scalar(target); };
  return add(std::move(key), std::move(doc), simple_shape(Form::text), read, write);
}

Field& Fields::path(std::string key, std::string& target, std::string doc) {
  if (!target.empty() && !std::filesystem::path(target).is_absolute()) {
    throw std::logic_error(fmt::format("the path '{}' must be empty or absolute", key));
  }
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    if (reader.text(v, field, target)) target = resolve_path(v.mark, target);
  };
  const auto write = [&target] { return Value::scalar(target); };
  return add(std::move(key), std::move(doc), simple_shape(Form::path), read, write);
}

Field& Fields::texts(std::string key, std::vector<std::string>& target, std::string doc) {
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    if (!reader.list(v, field)) return;
    target.assign(v.items.size(), "");
    for (std::size_t i = 0; i < v.items.size(); ++i) reader.text(v.items[i], field, target[i]);
  };
  return add(std::move(key), std::move(doc), list_shape(simple_shape(Form::text)), read, [&target] { return write_texts(target); });
}

Field& Fields::paths(std::string key, std::vector<std::string>& target, std::string doc) {
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    if (!reader.list(v, field)) return;
    target.assign(v.items.size(), "");
    for (std::size_t i = 0; i < v.items.size(); ++i)
      if (reader.text(v.items[i], field, target[i])) target[i] = resolve_path(v.items[i].mark, target[i]);
  };
  return add(std::move(key), std::move(doc), list_shape(simple_shape(Form::path)), read, [&target] { return write_texts(target); });
}

Field& Fields::numbers(std::string key, std::vector<double>& target, Unit unit, std::string doc) {
  for (const double value : target) require_finite(key, value);
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    if (v.is_sequence()) target.assign(v.items.size(), 0.0);
    read_doubles(v, field, reader, target.data());
  };
  const auto write = [&target] { return write_doubles(target.data(), target.size()); };
  Shape shape = list_shape(simple_shape(Form::number, unit));
  return add(std::move(key), std::move(doc), std::move(shape), read, write);
}

Field& Fields::doubles(std::string key, double* target, int count, Unit unit, std::string doc) {
  for (int i = 0; i < count; ++i) require_finite(key, target[i]);
  const auto read = [target](const Value& v, const Field& field, Reader& reader) {
    read_doubles(v, field, reader, target);
  };
  const auto write = [target, count] {
    return write_doubles(target, static_cast<std::size_t>(count));
  };
  Shape shape = list_shape(simple_shape(Form::number, unit), count);
  return add(std::move(key), std::move(doc), std::move(shape), read, write);
}

Field& Fields::integers(std::string key, int* target, int count, std::string doc) {
  const auto read = [target](const Value& v, const Field& field, Reader& reader) {
    if (!reader.list(v, field)) return;
    int* next = target;
    for (const Value& item : v.items) reader.integer(item, field, *next++);
  };
  const auto write = [target, count] {
    Value list = Value::sequence();
    for (int i = 0; i < count; ++i) list.items.push_back(Value::scalar(std::to_string(target[i])));
    return list;
  };
  Shape shape = list_shape(simple_shape(Form::integer), count);
  return add(std::move(key), std::move(doc), std::move(shape), read, write);
}

Field& Fields::vector(std::string key, Vec3& target, Unit unit, std::string doc) {
  return doubles(std::move(key), target.data(), 3, unit, std::move(doc));
}

Field& Fields::vector(std::string key, Vec2& target, Unit unit, std::string doc) {
  return doubles(std::move(key), target.data(), 2, unit, std::move(doc));
}

Field& Fields::vector(std::string key, std::array<int, 3>& target, std::string doc) {
  return integers(std::move(key), target.data(), 3, std::move(doc));
}

Field& Fields::vector(std::string key, std::array<int, 2>& target, std::string doc) {
  return integers(std::move(key), target.data(), 2, std::move(doc));
}

Field& Fields::vectors(std::string key, std::vector<Vec2>& target, Unit unit, std::string doc) {
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    if (!reader.list(v, field)) return;
    target.assign(v.items.size(), Vec2::Zero());
    for (std::size_t i = 0; i < v.items.size(); ++i) {
      const Value& pair = v.items[i];
      if (!pair.is_sequence() || pair.items.size() != 2)
        return reader.error(pair.mark, fmt::format("{}: expects pairs of {}, got {}", field.key, plural(field.shape.unit.quantity), pair.description()));
      for (int k = 0; k < 2; ++k) reader.number(pair.items[k], field, target[i][k]);
    }
  };
  const auto write = [&target] {
    Value list = Value::sequence();
    for (const Vec2& pair : target) list.items.push_back(write_doubles(pair.data(), 2));
    return list;
  };
  Shape shape = list_shape(list_shape(simple_shape(Form::number, unit), 2));
  return add(std::move(key), std::move(doc), std::move(shape), read, write);
}

Field& Fields::optional_vector(std::string key, std::optional<Vec3>& target, Unit unit,
                               std::string doc) {
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    if (v.is_null()) return target.reset();
    target = Vec3::Zero();
    read_doubles(v, field, reader, target->data());
  };
  const auto write = [&target] { return target ? write_doubles(target->data(), 3) : Value(); };
  Shape shape = nullable(list_shape(simple_shape(Form::number, unit), 3));
  return add(std::move(key), std::move(doc), std::move(shape), read, write);
}

Field& Fields::schedule(std::string key, Schedule& target, Unit unit, std::string doc) {
  for (const Schedule::Point& p : target.points()) require_finite(key, p.value);
  const auto read = [&target](const Value& v, const Field& field, Reader& reader) {
    read_schedule(v, field, reader, target);
  };
  const auto write = [&target] { return write_schedule(target); };
  return add(std::move(key), std::move(doc), simple_shape(Form::schedule, unit), read, write);
}

Field& Fields::raw(std::string key, Value& target, std::string doc) {
  const auto read = [&target](const Value& v, const Field&, Reader&) { target = v; };
  const auto write = [&target] { return target; };
  return add(std::move(key), std::move(doc), nullable(simple_shape(Form::any)), read, write);
}

Field& Fields::choice_by_index(std::string key, std::string doc, std::vector<Shape::Option> options,
                               std::function<void(std::size_t)> set,
                               std::function<std::size_t()> get) {
  Shape shape = simple_shape(Form::choice);
  shape.options = std::move(options);
  const auto read = [set](const Value& v, const Field& field, Reader& reader) {
    const std::size_t option = reader.option(v, field);
    if (option < field.shape.options.size()) set(option);
  };
  const auto write = [get, names = shape.options] { return Value::scalar(names[get()].name); };
  return add(std::move(key), std::move(doc), std::move(shape), read, write);
}

}  // namespace tack
