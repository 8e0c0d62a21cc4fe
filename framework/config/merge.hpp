// Merging of a file into the files that it includes.
#pragma once

#include "framework/config/value.hpp"

namespace tack {

// Lays `over` over `base`:
//    maps                              merged key by key
//    lists of named entries            entries of equal `name` merged, new ones appended
//    lists of entries with `between`   merged by the two objects, in any order
//    an entry with `remove: true`      removes the entry of its key
//    an entry with `replace: true`     replaces the entry of its key as a whole
//    anything else                     replaced, also two maps of different `type`
// Throws InputError with its source location for a name that occurs twice in a list, or is not
// there to be removed or replaced.
void merge(Value& base, Value over);

}  // namespace tack
