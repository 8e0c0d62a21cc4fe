#include "framework/view/preview_selections.hpp"

#include <fmt/format.h>

#include <map>

#include "framework/config/bind.hpp"
#include "framework/config/quantity.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// A `select` on its own, with the parameters that its numbers may use.
struct SelectConfig {
  std::unique_ptr<Selection> select;
  std::map<std::string, Quantity> parameters;
  void fields(Fields& f) {
    f.component("select", select, "vertices");
    f.quantities("parameters", parameters, "numbers with names");
  }
};

class SelectionSearch {
 public:
  SelectionSearch(const Value& root, const World& world) : root_(root), world_(world) {}

  std::vector<ShownSelection> find() {
    for (const Body& body : world_.bodies)
      for (const auto& [name, vertices] : body.tags) {
        std::vector<int> global = vertices;
        for (int& v : global) v += body.first_vertex;
        add(fmt::format("{}: group {}", body.name, name), body, std::move(global));
      }
    for (const Value::Entry& entry : root_.entries) {
      if (entry.key == "objects") {
        for (size_t i = 0; i < entry.value.items.size() && i < world_.bodies.size(); ++i) search(entry.value.items[i], world_.bodies[i].name + ":", static_cast<int>(i));
      } else if (entry.key != "selections") {
        search(entry.value, entry.key, -1);
      }
    }
    return std::move(found_);
  }

 private:
  // body: the body of a `select` without an object; -1: none.
  void search(const Value& value, const std::string& where, int body) {
    for (size_t i = 0; i < value.items.size(); ++i) search(value.items[i], fmt::format("{} {}", where, entry_name(value.items[i], i)), body);
    if (!value.is_map()) return;
    if (const Value* object = value.find("object"); object && object->is_scalar()) body = world_.body_index(object->text);
    for (const Value::Entry& entry : value.entries) {
      if (entry.key == "select" && body >= 0) choose(entry.value, where, world_.bodies[static_cast<size_t>(body)]);
      else if (entry.key != "select" && entry.key != "selections") search(entry.value, where + " " + entry.key, body);
    }
  }

  // Returns the name of an entry, else its index and type.
  static std::string entry_name(const Value& entry, size_t number) {
    if (const Value* name = entry.find("name"); name && name->is_scalar()) return name->text;
    const Value* type = entry.find("type");
    return type && type->is_scalar() ? fmt::format("{} ({})", number, type->text) : std::to_string(number);
  }

  void choose(const Value& select, const std::string& where, const Body& body) {
    Value map = Value::map();
    map.set("select", select);
    if (const Value* parameters = root_.find("parameters")) map.set("parameters", *parameters);
    SelectConfig config;
    try {
      bind(map, config, "a selection");
      if (config.select) add(where, body, config.select->choose({body, world_.rest}));
    } catch (const InputError&) {
      // Scenes that cannot run report the error elsewhere.
    }
  }

  void add(std::string name, const Body& body, std::vector<int> vertices) {
    if (vertices.empty() || static_cast<int>(vertices.size()) == body.vertex_count) return;
    found_.push_back({std::move(name), std::move(vertices)});
  }

  const Value& root_;
  const World& world_;
  std::vector<ShownSelection> found_;
};

}  // namespace

std::vector<ShownSelection> shown_selections(const Value& root, const World& world) { return SelectionSearch(root, world).find(); }

}  // namespace tack
