// Headings of the documents: share/docs of a build, share/tack/docs of an installation.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tack {

struct PageHeading {
  std::string page;  // with its anchor: "docs/scenes.md#friction"
  std::string text;
};

// Returns the headings of all pages below `folder` but those of the log and of the reference, by
// page and line. Returns none if the folder does not exist.
std::vector<PageHeading> page_headings(const std::filesystem::path& folder);

// Returns the anchor that GitHub and the site give to a heading: "Units, includes" is
// "units-includes".
std::string anchor_of(const std::string& heading);

}  // namespace tack
