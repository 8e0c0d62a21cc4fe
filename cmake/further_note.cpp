// Of libtack_further.so: what it was built against, read before it is loaded.
#include "cmake/plugin_note.cpp"
