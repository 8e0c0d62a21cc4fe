// Components chosen by name in a scene file (`type: fang`), and the registries that hold them.
//
// A kind of component is a base class that derives from Component and has:
//    static constexpr const char* kind_name = "normal_law";
//    static constexpr const char* kind_doc = "Potential of the gap between two surfaces.";
// A component is a class of that kind which registers itself in its own .cpp, at namespace scope:
//    TACK_REGISTER(NormalLaw, FangAdhesion, "fang", "One sentence.", "Fang et al., eq. 10-12");
// Registration runs before main, or when a plugin is loaded (framework/plugin). Object files must
// be linked whole (OBJECT libraries). Registering a name or a class twice ends the program at its
// start. Entries are sorted by name, whatever the link order.
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

/// Base of all components.
struct Component {
  virtual ~Component() = default;

  /// Lists the parameters; see field.hpp.
  virtual void fields(Fields&) {}

  /// Returns an addition to the doc sentence in listings, "" for none: "irreversible; acts along
  /// the normal".
  virtual std::string traits_text() const { return {}; }

  /// Returns the registered name of this object's class, "" if it has none. A look-up: not for hot
  /// loops.
  std::string_view type() const;
};

/// A kind of component and its registered classes, type-erased.
class Kind {
 public:
  struct Entry {
    std::string name;
    std::string doc;
    std::string source;  ///< citation
    std::string file;    ///< relative to the source tree
    std::function<std::unique_ptr<Component>()> factory;
    std::string plugin = {};  ///< library that registered it; "" for the program
  };

  /// Returns the kind of that name, created on first use. A kind exists once per program,
  /// whichever library asks. Throws std::logic_error if it has another base class.
  static Kind& named(const char* name, const char* doc, std::type_index base);

  Kind(std::string name, std::string doc) : name_(std::move(name)), doc_(std::move(doc)) {}
  Kind(const Kind&) = delete;
  Kind& operator=(const Kind&) = delete;

  const std::string& name() const { return name_; }
  const std::string& doc() const { return doc_; }
  std::vector<std::string> names() const;  ///< sorted, including components not yet loaded
  const std::map<std::string, Entry, std::less<>>& entries() const { return entries_; }

  /// Returns an entry, after loading its library if necessary. Throws InputError, without a source
  /// location: "unknown energy 'neo_hokean'; did you mean 'neo_hookean'? (...)", or the error of
  /// loading.
  const Entry& entry(std::string_view name) const;

  /// Loads all of the kind's components. Throws the error of loading.
  void complete() const;

  /// Returns the fields of a new instance (defaults), which the result keeps alive.
  Fields prototype(std::string_view name) const;

  /// Registers a class. Throws std::logic_error if its name or class is registered already. While
  /// a plugin is loading, the error is stored in its PluginRegistrations instead; names of
  /// components not yet loaded count as registered then.
  void add(Entry entry, std::type_index type);

 private:
  friend class PluginRegistrations;
  std::string name_;
  std::string doc_;
  std::map<std::string, Entry, std::less<>> entries_;
};

/// Components that register themselves when their library is loaded, on first use of one of them.
struct LoadableComponents {
  std::map<std::string, std::vector<std::string>, std::less<>> names;  ///< names per kind
  std::function<void()> load;  ///< registers them; throws InputError, without a source location
};
void set_loadable_components(LoadableComponents components);

/// Returns all kinds that are used or have components, sorted by name.
std::vector<const Kind*> registered_kinds();

/// Scope that collects the registrations of a loading plugin and removes them at its end unless
/// keep() was called. Errors are stored, because initialisers of a library must not throw. One
/// scope at a time.
class PluginRegistrations {
 public:
  explicit PluginRegistrations(std::string plugin);
  ~PluginRegistrations();
  PluginRegistrations(const PluginRegistrations&) = delete;
  PluginRegistrations& operator=(const PluginRegistrations&) = delete;

  bool empty() const { return added_.empty(); }
  const std::vector<std::string>& errors() const { return errors_; }
  void commit() { added_.clear(); }

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

/// The typed registry of the kind with base class Base.
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

  /// Downcasts a component made by this registry's kind.
  static std::unique_ptr<Base> downcast(std::unique_ptr<Component> component) {
    return std::unique_ptr<Base>(static_cast<Base*>(component.release()));
  }
};

/// Registers class Derived at its construction; made by TACK_REGISTER.
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
