// First words of the warnings among notes.hpp, for callers and tests that tell them apart.
#pragma once

#include <algorithm>
#include <string_view>

#include "geometry/meshing/notes.hpp"

namespace tack::mesh_warning {

inline constexpr std::string_view any = "warning: ";
inline constexpr std::string_view changed_area = "warning: its area is ";
inline constexpr std::string_view lost_edges = "warning: edges of less than ";
inline constexpr std::string_view rounded_creases = "warning: creases of less than ";
inline constexpr std::string_view missed_deviation = "warning: that is more than the ";
inline constexpr std::string_view missed_angle = "warning: the dihedral angle ";

// Returns whether a note has these first words.
inline bool given(const Notes& notes, std::string_view words) {
  return std::any_of(notes.begin(), notes.end(),
                     [&](const std::string& note) { return note.starts_with(words); });
}

}  // namespace tack::mesh_warning
