// A page of a scene before it runs: initial configuration, prescribed motions, selections, contact
// ranges and warnings.
#pragma once

#include <string>
#include <vector>

#include "framework/report/page.hpp"

namespace tack {

struct PreviewSettings {
  std::string file;                    // the scene
  std::vector<std::string> overrides;  // "a.b=c"
  std::string version, commit;         // of the program
};

// Returns page data of kind `preview`: preview {error, warnings, notes, duration, bodies [{name,
// vertices, tets, triangles, edges, points, held, extent [m], contact [m], adhesion [m]}]}, and one
// run with `selections` [{name, count, block}]. A scene that cannot run, for instance because its
// start intersects, is shown without contact if possible; else throws InputError.
PageData preview_data(const PreviewSettings& settings);

}  // namespace tack
