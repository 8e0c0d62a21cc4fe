// Options that both Ceres minimisers share.
#pragma once

#include <ceres/types.h>
#include <gflags/gflags_declare.h>

DECLARE_int32(minloglevel);  // of glog, through which Ceres writes to stderr

namespace tack {

// Turns off all output of Ceres; its report goes into the minimiser's status.
template <class Options>
void silence(Options& options) {
  options.logging_type = ceres::SILENT;
  options.minimizer_progress_to_stdout = false;
  FLAGS_minloglevel = 3;  // fatal errors only
}

}  // namespace tack
