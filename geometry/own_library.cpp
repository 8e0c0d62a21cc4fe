#include "geometry/own_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <atomic>
#include <cstring>

#include "geometry/errors.hpp"

namespace tack {

namespace fs = std::filesystem;

// The dynamic loader knows the path of a library; for the program it only knows the name of the call.
fs::path own_file() {
  std::error_code none;
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&own_file), &info) != 0 && fs::path(info.dli_fname).extension() == ".so") return fs::canonical(info.dli_fname, none);
  return fs::read_symlink("/proc/self/exe", none);
}

// Packages keep libtack.so in a folder below lib/ (one for each instruction set, one of a Python package), so the root is the nearest folder with share/.
fs::path own_root() {
  std::error_code none;
  const fs::path usual = own_file().parent_path().parent_path();
  for (fs::path root = usual; root.has_relative_path(); root = root.parent_path())
    if (fs::is_directory(root / "share", none)) return root;
  return usual;
}

fs::path shared_file(const std::string& name) {
  std::error_code none;
  const fs::path share = own_root() / "share", installed = share / "tack" / name;
  return fs::exists(installed, none) ? installed : share / name;
}

bool is_installed() {
  std::error_code none;
  return fs::is_directory(own_root() / "share" / "tack", none);
}

std::string remedy_for_missing(const std::string& target, const std::string& script) {
  if (is_installed()) return "install tack again, since this installation lacks it";
  return fmt::format("run `{}`, which builds it, or `cmake --build --preset release --target {}`", script, target);
}

// Tests are in a folder beside bin/, and use the libraries there.
fs::path own_library_path(const std::string& name) {
  std::error_code none;
  const fs::path root = own_root();
  const fs::path installed = root / "lib" / "tack" / name;
  return fs::exists(installed, none) ? installed : root / "bin" / name;
}

namespace {

std::atomic<const char*> missing{""};

const void* functions_of(const OwnLibrary& library) {
  const std::string path = own_library_path(library.file).string();
  void* opened = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!opened) throw InputError(fmt::format("the library for it is not built or broken ({})", ::dlerror()));
  const void* functions = ::dlsym(opened, library.table);
  if (!functions || std::strcmp(*static_cast<const char* const*>(functions), library.interface) != 0)
    throw InputError(path + " is of another build");
  return functions;
}

}  // namespace

const void* open_library(const OwnLibrary& library) {
  try {
    return functions_of(library);
  } catch (const InputError& error) {
    missing = library.target;
    throw InputError(fmt::format("{}: {}; {}", library.without, error.what(), remedy_for_missing(library.target)));
  }
}

const char* missing_library() { return missing; }

}  // namespace tack
