// How far each vertex is from the nearest of what contact sees of it.
#pragma once

#include "geometry/types.hpp"

namespace tack {

class ContactSystem;

// One per vertex [m], the offset of thickness taken off; a vertex of an edge or a triangle counts with the gap of what it belongs to. Not a
// number where nothing is within reach of the laws. The system must be at x.
VecX vertex_gaps(const ContactSystem& contact, const VecX& x);

}  // namespace tack
