// The largest memory that the program has used since an object was made (Linux: VmHWM, whose reset
// needs a kernel that has /proc/self/clear_refs; without, it is the most since the program began).
#pragma once

#include <fstream>
#include <string>

namespace tack::bench {

class MemoryPeak {
 public:
  MemoryPeak() { std::ofstream("/proc/self/clear_refs") << "5"; }

  // Resident memory of the whole program; 0 if the system does not report it.
  double megabytes() const {
    std::ifstream in("/proc/self/status");
    for (std::string word; in >> word;) {
      double kibibytes = 0;
      if (word == "VmHWM:" && in >> kibibytes) return kibibytes / 1024;
    }
    return 0;
  }
};

}  // namespace tack::bench
