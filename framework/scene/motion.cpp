#include "framework/scene/motion.hpp"

namespace tack {
namespace {

class Fixed : public Motion {};

TACK_REGISTER(Motion, Fixed, "fixed", "Vertices that never move and own no unknowns.", "");

}  // namespace
}  // namespace tack
