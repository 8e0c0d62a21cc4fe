#include "framework/scene/energy.hpp"

#include "framework/config/field.hpp"

namespace tack {

void Energy::fields(Fields& f) {
  f.component("select", select_, "it acts on, and gives mass to, the elements all of whose vertices are chosen; unless given, all");
}

}  // namespace tack
