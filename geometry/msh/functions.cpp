#include "geometry/msh/functions.hpp"

extern "C" __attribute__((visibility("default"))) const tack::MshFunctions tack_msh_functions = {
    TACK_MSH_INTERFACE,
    tack::read_msh_by_gmsh,
    tack::write_msh_by_gmsh,
};
