#include "framework/plugin/plugins.hpp"

#include <cxxabi.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "framework/config/parse.hpp"
#include "framework/config/reader.hpp"
#include "framework/config/registry.hpp"
#include "framework/plugin/interface_mismatch.hpp"
#include "framework/plugin/further_components.hpp"
#include "geometry/checksum.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

std::vector<Plugin>& plugins() {
  static std::vector<Plugin> loaded;
  return loaded;
}

void check_interface(const std::string& path) {
  if (const std::string what = interface_mismatch(path); !what.empty())
    throw InputError(fmt::format("'{}' is a plugin for another tack: {}; build it anew against this one, with the compiler "
                                 "that built it", path, what));
}

// Demangles a message: "undefined symbol: tack::Fields::all() const".
std::string readable(std::string message) {
  const size_t begin = message.find("_Z");
  if (begin == std::string::npos) return message;
  const size_t end = std::min(message.find_first_of(" ,)", begin), message.size());
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> name(
      abi::__cxa_demangle(message.substr(begin, end - begin).c_str(), nullptr, nullptr, &status), std::free);
  return name ? message.replace(begin, end - begin, name.get()) : message;
}

// Returns true if the library calls a function of tack that this program lacks, or has not loaded
// yet.
struct Undefined : InputError {
  using InputError::InputError;
};

// Owns a library; closes it unless it is released.
class Library {
 public:
  explicit Library(const std::string& path) {
    handle_ = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle_) return;
    const std::string why = readable(::dlerror());
    const char* remedy = "it must be linked with what it calls, and may call of tack what its headers declare";
    if (why.find("::packs_of_") != std::string::npos)
      remedy = "materials of solids need the instruction set of the program: link tack::native as well (docs/plugins.md)";
    const std::string what = fmt::format("cannot load the plugin: {}; {}", why, remedy);
    if (why.find("undefined symbol") != std::string::npos) throw Undefined(what);
    throw InputError(what);
  }
  ~Library() {
    if (handle_) ::dlclose(handle_);
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  void keep() { handle_ = nullptr; }

 private:
  void* handle_ = nullptr;
};

std::uint32_t checksum_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  return crc32_of(bytes.data(), bytes.size());
}

void open_plugin(const std::string& path) {
  std::unique_ptr<Library> library;  // destroyed after the registrations
  PluginRegistrations registrations(path);
  library = std::make_unique<Library>(path);
  if (!registrations.errors().empty())
    throw InputError(fmt::format("plugin '{}': {}; choose another name", path, registrations.errors().front()));
  if (registrations.empty())
    throw InputError(fmt::format("plugin '{}' registers no component; write TACK_REGISTER in its sources", path));
  registrations.commit();
  library->keep();
}

}  // namespace

const std::vector<Plugin>& loaded_plugins() { return plugins(); }

void load_plugin(const std::string& given) {
  std::error_code missing;
  const std::string path = fs::canonical(given, missing).string();
  if (missing || !fs::is_regular_file(path))
    throw InputError(fmt::format("there is no library '{}'; build the plugin, or correct the path", given));
  const auto same = [&](const Plugin& p) { return p.path == path; };
  if (std::any_of(plugins().begin(), plugins().end(), same)) return;

  check_interface(path);
  try {
    open_plugin(path);
  } catch (const Undefined&) {
    if (!load_further_components()) throw;
    open_plugin(path);
  }
  plugins().push_back({path, checksum_of(path)});
}

void load_plugins(const Value& root) {
  const Value* list = root.find("plugins");
  if (!list || !list->is_sequence()) return;
  Reader reader;
  for (const Value& item : list->items) {
    if (!item.is_scalar()) continue;
    try {
      load_plugin(resolve_path(item.mark, item.text));
    } catch (const InputError& error) {
      reader.error(item.mark, fmt::format("plugins: {}", error.what()));
    }
  }
  reader.finish();
}

}  // namespace tack
