// The interface that a plugin and its program must share, as lines of text. The preprocessor writes
// the lines into both (interface_note.cpp for plugins); an error message quotes the line that
// differs. Instruction sets and optimisation may differ.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "framework/plugin/headers_digest.hpp"

// Section of a plugin's file that holds the lines.
#define TACK_PLUGIN_SECTION ".tack.plugin"

#ifdef _GLIBCXX_DEBUG
#define TACK_CHECKED_CONTAINERS "1"
#else
#define TACK_CHECKED_CONTAINERS "0"
#endif
#define TACK_TEXT_(x) #x
#define TACK_TEXT(x) TACK_TEXT_(x)

#define TACK_PLUGIN_INTERFACE \
  "tack " TACK_HEADERS_VERSION "\n" \
  "headers " TACK_HEADERS_DIGEST "\n" \
  "Eigen " TACK_TEXT(EIGEN_WORLD_VERSION) "." TACK_TEXT(EIGEN_MAJOR_VERSION) "." \
  TACK_TEXT(EIGEN_MINOR_VERSION) "\n" \
  "Eigen's alignment " TACK_TEXT(EIGEN_MAX_ALIGN_BYTES) " " \
  TACK_TEXT(EIGEN_MAX_STATIC_ALIGN_BYTES) "\n" \
  "libstdc++ " TACK_TEXT(_GLIBCXX_RELEASE) "\n" \
  "_GLIBCXX_USE_CXX11_ABI " TACK_TEXT(_GLIBCXX_USE_CXX11_ABI) "\n" \
  "_GLIBCXX_DEBUG " TACK_CHECKED_CONTAINERS "\n" \
  "ABI of the compiler " TACK_TEXT(__GXX_ABI_VERSION) "\n"
