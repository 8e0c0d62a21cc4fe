#include "framework/world/load.hpp"

#include "framework/load/following_load.hpp"

namespace tack {

std::unique_ptr<FollowingLoad> Load::make_term(const Body&, const VecX&, const VecX&) const { return nullptr; }

}  // namespace tack
