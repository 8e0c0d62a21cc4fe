// Settings that both minimisers of Ceres share.
#pragma once

#include <ceres/types.h>
#include <gflags/gflags_declare.h>

DECLARE_int32(minloglevel);  // of glog, through which Ceres speaks to stderr

namespace tack {

// Nothing is printed: what Ceres reports goes into our status.
template <class Options>
void silence(Options& options) {
  options.logging_type = ceres::SILENT;
  options.minimizer_progress_to_stdout = false;
  FLAGS_minloglevel = 3;  // only what ends the program
}

}  // namespace tack
