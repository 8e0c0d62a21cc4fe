#include "framework/scene/energy.hpp"

#include "framework/config/field.hpp"

namespace tack {

void Energy::fields(Fields& f) {
  f.component("select", select_, "elements it acts on and gives mass to: those with all vertices selected; all unless given");
}

}  // namespace tack
