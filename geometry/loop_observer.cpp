#include "geometry/loop_observer.hpp"

namespace tack {

constinit thread_local LoopObserver* loop_observer = nullptr;

}  // namespace tack
