// Gap of each vertex to the nearest of its contacts.
#pragma once

#include "geometry/types.hpp"

namespace tack {

class ContactSystem;

// Returns, per vertex [m], the gap less contact offsets. A vertex of an edge or triangle gets the
// gap of that primitive; NaN where nothing is within range of the laws. Throws logic_error if x is
// not the configuration of the system.
VecX vertex_gaps(const ContactSystem& contact, const VecX& x);

}  // namespace tack
