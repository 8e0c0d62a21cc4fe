#include "geometry/hdf5/functions.hpp"

extern "C" __attribute__((visibility("default"))) const tack::Hdf5Functions tack_hdf5_functions = {
    TACK_HDF5_INTERFACE,
    tack::write_table_by_hdf5,
};
