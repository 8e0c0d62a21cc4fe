// Components chosen by name in a scene file (`type: fang`), and the registries that hold them.
//
// A kind of component is a base class that derives from Component and has
//   static constexpr const char* kind_name = "normal_law";
//   static constexpr const char* kind_doc = "Potential of the gap between two surfaces.";
// A component is a class of that kind which registers itself in its own .cpp, at namespace scope:
//   TACK_REGISTER(NormalLaw, FangAdhesion, "fang", "One sentence.", "Fang et al., eq. 10-12");
// Registration runs before main, so the object file has to be linked whole (OBJECT libraries); that of
// a plugin when it is loaded (framework/plugin). A name or a class registered twice is an error that ends
// the program at its start. Entries are sorted by name, whatever the link order.
#pragma once

#include <concepts>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <typeindex>
#include <vector>

namespace tack {

class Fields;

struct Component {
  virtual ~Component() = default;

  // Lists the parameters; see field.hpp.
  virtual void fields(Fields&) {}

  // What listings say of it besides its sentence, "" for nothing: "irreversible; acts along the normal".
  virtual std::string traits_text() const { return {}; }

  // The registered name of this object's class, "" if it has none. A look-up: not for hot loops.
  std::string_view type() const;
};

// One kind, with the classes of its components erased.
class Kind {
 public:
  struct Entry {
    std::string name;
    std::string doc;
    std::string source;  // citation
    std::string file;    // relative to the source tree
    std::function<std::unique_ptr<Component>()> factory;
    std::string plugin = {};  // the library that it came with; "" for the program's own
  };

  // The kind of that name, made when it is first asked for. There is one in the program, whichever library asks. Throws
  // std::logic_error if it has components of another base class.
  static Kind& named(const char* name, const char* doc, std::type_index base);

  Kind(std::string name, std::string doc) : name_(std::move(name)), doc_(std::move(doc)) {}
  Kind(const Kind&) = delete;
  Kind& operator=(const Kind&) = delete;

  const std::string& name() const { return name_; }
  const std::string& doc() const { return doc_; }
  std::vector<std::string> names() const;  // sorted, with those that are elsewhere
  const std::map<std::string, Entry, std::less<>>& entries() const { return entries_; }

  // Of one that is elsewhere, after what has it is loaded. Throws InputError, without a place: "unknown energy 'neo_hokean'; did you
  // mean 'neo_hookean'? (...)", or what loading threw.
  const Entry& entry(std::string_view name) const;

  // Afterwards none of its components is elsewhere. Throws what loading threw.
  void complete() const;

  // The fields of a fresh instance, which the result keeps alive: its defaults.
  Fields prototype(std::string_view name) const;

  // Throws std::logic_error if the name or the class is registered already; while a plugin is loaded, keeps that for
  // its PluginRegistrations, for which the names of what is elsewhere are taken too.
  void add(Entry entry, std::type_index type);

 private:
  friend class PluginRegistrations;
  std::string name_;
  std::string doc_;
  std::map<std::string, Entry, std::less<>> entries_;
};

// Components that register themselves when a library is loaded, which is done once one of them is named.
struct ComponentsElsewhere {
  std::map<std::string, std::vector<std::string>, std::less<>> names;  // of each kind
  std::function<void()> load;                                         // registers them; throws InputError, without a place
};
void note_components_elsewhere(ComponentsElsewhere components);

// All kinds that are used or have components, sorted by name.
std::vector<const Kind*> registered_kinds();

// What registers itself while this lives is a plugin's, and is taken back unless it is kept: initialisers of a library must
// not throw. One at a time.
class PluginRegistrations {
 public:
  explicit PluginRegistrations(std::string plugin);
  ~PluginRegistrations();
  PluginRegistrations(const PluginRegistrations&) = delete;
  PluginRegistrations& operator=(const PluginRegistrations&) = delete;

  bool empty() const { return added_.empty(); }
  const std::vector<std::string>& errors() const { return errors_; }
  void keep() { added_.clear(); }

 private:
  friend class Kind;
  struct Added {
    Kind* kind;
    std::string name;
    std::type_index type;
  };

  std::string plugin_;
  std::vector<Added> added_;
  std::vector<std::string> errors_;
};

template <class Base>
requires std::derived_from<Base, Component>
class Registry {
 public:
  static Kind& kind() {
    static Kind& kind = Kind::named(Base::kind_name, Base::kind_doc, typeid(Base));
    return kind;
  }

  static std::unique_ptr<Base> make(std::string_view name) {
    return downcast(kind().entry(name).factory());
  }

  // For a component that came out of this registry's kind.
  static std::unique_ptr<Base> downcast(std::unique_ptr<Component> component) {
    return std::unique_ptr<Base>(static_cast<Base*>(component.release()));
  }
};

template <class Base, std::derived_from<Base> Derived>
struct Registration {
  Registration(const char* name, const char* doc, const char* source, const char* file) {
    Registry<Base>::kind().add(
        {name, doc, source, file, [] { return std::make_unique<Derived>(); }}, typeid(Derived));
  }
};

}  // namespace tack

#define TACK_JOIN_(a, b) a##b
#define TACK_JOIN(a, b) TACK_JOIN_(a, b)
#define TACK_REGISTER(Base, Derived, name, doc, source)                                   \
  static const ::tack::Registration<Base, Derived> TACK_JOIN(registration_, __COUNTER__)( \
      name, doc, source, __FILE__)
