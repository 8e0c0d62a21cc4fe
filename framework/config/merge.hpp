// What an including file does to one that it includes.
#pragma once

#include "framework/config/value.hpp"

namespace tack {

// Lays `over` over `base`: maps are merged key by key, and lists in which every entry has a `name`, or
// else a `between`, entry by entry: those of one name (of the same two objects, in any order) are merged, new ones
// appended. An entry with `remove: true` removes the one of its name, with `replace: true` it takes its place
// whole. Everything else is replaced, also two maps of different `type`s. Throws InputError with its place for a
// name that is given twice in a list or not there to be removed or replaced.
void merge(Value& base, Value over);

}  // namespace tack
