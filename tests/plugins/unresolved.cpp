// A plugin that calls what the program does not have.
namespace tack {
inline namespace packs_of_3 {
class Pack;
}
void no_such_function(ARGUMENT);
}  // namespace tack

namespace {
const int initialised = (tack::no_such_function({}), 0);
}
