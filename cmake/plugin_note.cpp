// Compiled into every plugin by the target tack::plugin, and into libtack_further.so: what it was built against, read before it is loaded.
#include "framework/plugin/interface.hpp"

extern "C" {
extern const char tack_plugin_interface[];
[[gnu::used, gnu::section(TACK_PLUGIN_SECTION)]] const char tack_plugin_interface[] = TACK_PLUGIN_INTERFACE;
}
