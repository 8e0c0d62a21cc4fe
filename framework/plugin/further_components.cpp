#include "framework/plugin/further_components.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "framework/config/registry.hpp"
#include "framework/plugin/interface_mismatch.hpp"
#include "geometry/errors.hpp"
#include "geometry/own_library.hpp"

namespace tack {
namespace {

enum class Further { here, elsewhere, failed };
Further further = Further::here;

const std::map<std::string, std::vector<std::string>, std::less<>> further_names = {
    {"adhesion", {"after_dwell", "over_temperature", "over_time"}},
    {"contact_model", {"clipped", "gcp", "ipc", "ogc"}},
    {"energy", {"bergstrom_boyce", "elastic_rod", "expression", "expression_membrane", "gent", "gent_membrane", "hgo_fibres",
                "hinge_bending", "maxwell", "maxwell_bending", "maxwell_membrane", "maxwell_rod", "mooney_rivlin",
                "mooney_rivlin_membrane", "neo_hookean_membrane", "ogden", "ogden_membrane", "particle", "strain_limit",
                "string", "stvk_membrane", "von_mises", "von_mises_membrane", "yeoh", "yeoh_membrane"}},
    {"field", {"plastic_strain"}},
    {"filling", {"gas", "liquid"}},
    {"format", {"gltf", "mdd", "npy", "obj", "pc2", "ply", "usd"}},
    {"interaction", {"ball", "chamber", "hinge", "rope", "slider", "spring", "weld"}},
    {"load", {"chamber", "field", "torque", "wind"}},
    {"minimizer", {"ceres_line_search", "ceres_trust_region", "nlopt"}},
    {"probe", {"intact_springs", "joint_angle", "joint_way", "motor_force", "motor_torque", "rope_force", "spring_force"}},
    {"stepper", {"lcp_pgs", "path_following"}}};

bool linked() {
  for (const Kind* kind : registered_kinds())
    if (const auto found = further_names.find(kind->name()); found != further_names.end() && kind->entries().contains(found->second.front())) return true;
  return false;
}

void load_from(const std::string& path) {
  if (std::error_code none; !std::filesystem::exists(path, none)) throw InputError(path + " is not there");
  if (const std::string what = interface_mismatch(path); !what.empty()) throw InputError(fmt::format("{}: {}", path, what));
  // RTLD_GLOBAL: plugins may call functions of the library.
  if (!::dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL)) throw InputError(::dlerror());
}

}  // namespace

bool load_further_components() {
  if (further == Further::here) return false;
  further = Further::failed;
  try {
    load_from(own_library_path("libtack_further.so").string());
  } catch (const InputError& error) {
    throw InputError(fmt::format("the library that has it cannot be loaded ({}); {}", error.what(), remedy_for_missing("tack_further")));
  }
  further = Further::here;
  return true;
}

bool further_components_failed() { return further == Further::failed; }

void declare_further_components() {
  if (linked()) return;
  further = Further::elsewhere;
  set_loadable_components({further_names, [] { load_further_components(); }});
}

}  // namespace tack
