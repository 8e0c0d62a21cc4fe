#include "geometry/interrupt.hpp"

namespace tack {

std::atomic<bool> interrupt_requested{false};

}  // namespace tack
