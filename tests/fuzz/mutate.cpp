#include "tests/fuzz/mutate.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <vector>

namespace tack {
namespace {

using Random = std::mt19937_64;

// Below n; 0 for n = 0.
size_t below(Random& random, size_t n) { return n == 0 ? 0 : random() % n; }

template <class List>
const auto& one_of(Random& random, const List& list) {
  return list[below(random, std::size(list))];
}

const std::vector<std::string> numbers = {
    "0", "-0", "1", "-1", "2", "7", "1000", "2147483647", "2147483648", "-2147483648", "4294967295", "4294967296",
    "9223372036854775807", "-9223372036854775808", "18446744073709551616", "1e12", "1e-12", "1e-300", "1e-400", "1e150",
    "1e151", "1e308", "-1e308", "1e309", "nan", "inf", "-inf", "0.5", "-0.5", "1,5", "0x10", "1e", ".", "", "0.1000000001"};

const std::vector<std::string> words = {
    "", " ", "\n", "\t", "{", "}", "[", "]", "{}", "[]", ":", "- ", ",", "\"", "'", "#", "&a", "*a", "!!int", "null", "true",
    "type", "file", "/dev/zero", "/dev/null", ".", "..", "/", "nowhere.msh", "%", "@", "\\", "$", "`", "<", ">", "</", "\xff\xfe",
    "\xc3", "ASCII", "BINARY", "double", "include: .", "10 m", "1 km/h", "-5 cm", "1 GPa"};

// Ranges of the tokens of one kind.
using Span = std::pair<size_t, size_t>;
template <class Belongs>
std::vector<Span> spans(const std::string& text, const Belongs& belongs) {
  std::vector<Span> found;
  for (size_t i = 0; i < text.size(); ++i) {
    const size_t begin = i;
    while (i < text.size() && belongs(static_cast<unsigned char>(text[i]))) ++i;
    if (i > begin) found.emplace_back(begin, i);
  }
  return found;
}

bool of_number(unsigned char c) { return std::isdigit(c) || c == '.' || c == '-' || c == '+'; }
bool of_word(unsigned char c) { return std::isalnum(c) || c == '_'; }

void replace(std::string& text, const Span& span, const std::string& by) {
  text.replace(span.first, span.second - span.first, by);
}

void change_number(std::string& text, Random& random) {
  const auto found = spans(text, of_number);
  if (!found.empty()) replace(text, one_of(random, found), one_of(random, numbers));
}

void change_word(std::string& text, Random& random) {
  const auto found = spans(text, of_word);
  if (found.empty()) return;
  const Span other = one_of(random, found);
  const std::string known = text.substr(other.first, other.second - other.first);
  replace(text, one_of(random, found), random() % 2 ? known : one_of(random, words));
}

void change_lines(std::string& text, Random& random) {
  const auto lines = spans(text, [](unsigned char c) { return c != '\n'; });
  if (lines.empty()) return;
  const Span a = one_of(random, lines), b = one_of(random, lines);
  const std::string line = text.substr(a.first, a.second - a.first);
  switch (below(random, 3)) {
    case 0: return replace(text, a, "");
    case 1: text.insert(b.first, line + "\n"); return;
    default: return replace(text, b, line);
  }
}

void insert_word(std::string& text, Random& random) {
  text.insert(below(random, text.size() + 1), one_of(random, words));
}

void change_byte(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  char& c = bytes[below(random, bytes.size())];
  c = random() % 2 ? static_cast<char>(c ^ (1 << below(random, 8))) : static_cast<char>(random());
}

void change_integer(std::string& bytes, Random& random) {
  static constexpr std::array<std::int64_t, 10> values = {0, -1, 1, 255, 65536, INT32_MAX, INT32_MIN, 1LL << 32, INT64_MAX, INT64_MIN};
  const size_t size = random() % 2 ? 4 : 8;
  if (bytes.size() < size) return;
  const std::int64_t value = one_of(random, values);
  std::memcpy(&bytes[below(random, bytes.size() - size + 1)], &value, size);
}

void change_block(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  const size_t at = below(random, bytes.size()), length = 1 + below(random, std::min<size_t>(bytes.size() - at, 40));
  switch (below(random, 3)) {
    case 0: bytes.erase(at, length); return;
    case 1: bytes.insert(below(random, bytes.size()), bytes.substr(at, length)); return;
    default: bytes.resize(at);  // cut short
  }
}

}  // namespace

std::string mutated(const std::string& original, Random& random) {
  using Change = void (*)(std::string&, Random&);
  static constexpr std::array<Change, 10> of_text = {change_number, change_number, change_number, change_number, change_word,
                                                     change_word, change_lines, insert_word, change_byte, change_block};
  static constexpr std::array<Change, 4> of_bytes = {change_byte, change_integer, change_block, change_number};
  const bool is_text = std::all_of(original.begin(), original.end(), [](unsigned char c) { return c >= 32 || std::isspace(c); });
  std::string text = original;
  for (size_t changes = 1 + below(random, 3); changes > 0 || text == original; changes -= changes > 0)
    is_text ? one_of(random, of_text)(text, random) : one_of(random, of_bytes)(text, random);
  return text;
}

}  // namespace tack
