// Damage to a file: what transfer, editors, other programs and people do to it, and what breaks
// readers.
#pragma once

#include <random>
#include <string>

namespace tack {

// One to three changes, different from the original. Text changes in numbers, words and lines, too;
// binary files in bytes and in the integers among them. The same generator gives the same damage.
std::string mutated(const std::string& original, std::mt19937_64& random);

}  // namespace tack
