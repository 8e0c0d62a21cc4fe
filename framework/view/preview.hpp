// A scene before it is run, as a page: its bodies where they start, how its motions take what they hold, what it selects, how far contact reaches, and what
// is doubtful of it.
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

// Of kind `preview`: preview {error, warnings, notes, duration, bodies [{name, vertices, tets, triangles, edges, points, held, extent [m], contact [m], adhesion [m]}]}, and
// one run with `selections` [{name, count, block}]. A scene that cannot be run, as it starts with an intersection, say, is shown all the same, without contact, if it
// can be; else that is an InputError.
PageData preview_data(const PreviewSettings& settings);

}  // namespace tack
