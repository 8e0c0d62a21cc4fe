#include "geometry/level_set/stroke_font.hpp"

#include <fmt/format.h>

#include <cctype>
#include <map>

#include "geometry/errors.hpp"

namespace tack {
namespace {

// Each letter: its width, then polylines separated by blanks, whose pairs of digits are positions on a grid of height 6.
const std::map<char, std::string_view>& letters() {
  static const std::map<char, std::string_view> all = {
      {'A', "4 002640 0232"},        {'B', "4 00063645443303 3342413000"}, {'C', "4 4536160501103041"},
      {'D', "4 00062644422000"},   {'E', "3 36060030 0323"},       {'F', "3 360600 0323"},
      {'G', "4 45361605011030414323"}, {'H', "4 0006 4046 0343"},    {'I', "2 1016 0020 0626"},
      {'J', "3 3631201001"},         {'K', "4 0006 4602 1340"},      {'L', "3 060030"},
      {'M', "4 0006234640"},         {'N', "4 00064046"},            {'O', "4 100105163645413010"},
      {'P', "4 00063645443303"},    {'Q', "4 100105163645413010 2240"}, {'R', "4 00063645443303 2340"},
      {'S', "4 4536160504334241301001"}, {'T', "4 0646 2620"},         {'U', "4 060110304146"},
      {'V', "4 062046"},             {'W', "4 0610233046"},          {'X', "4 0046 0640"},
      {'Y', "4 062346 2320"},        {'Z', "4 06460040"},            {'0', "4 100105163645413010 0145"},
      {'1', "2 051610 0020"},        {'2', "4 0516364544010040"},    {'3', "4 051636454433 133342413010 1001"},
      {'4', "4 30360242"},           {'5', "4 460603334241301001"},   {'6', "4 453616050110304142331302"},
      {'7', "4 064620"},             {'8', "4 13040516364544331302011030414233"}, {'9', "4 011030414536160504133344"},
      {'.', "1 0001"},               {',', "1 1100"},                {'!', "1 0001 0306"},
      {'?', "3 051626353423 2322 2120"}, {'-', "3 0333"},            {'+', "4 2125 0343"},
      {'=', "3 0232 0434"},          {'/', "3 0036"},                {':', "1 0102 0405"},
      {'\'', "1 0406"},              {'&', "4 40051626350201102042"}, {' ', "2"}};
  return all;
}

}  // namespace

std::vector<Stroke> text_strokes(std::string_view text) {
  constexpr double height = 6, space = 2;
  std::vector<Stroke> strokes;
  double at = 0;
  for (const char c : text) {
    const auto found = letters().find(static_cast<char>(std::toupper(static_cast<unsigned char>(c))));
    if (found == letters().end())
      throw InputError(fmt::format("there is no letter '{}'; take capitals, digits and . , ! ? - + = / : ' &", c));
    const std::string_view lines = found->second;
    for (size_t i = 2; i + 3 < lines.size(); ++i) {
      if (lines[i] == ' ') continue;
      const auto position = [&](size_t k) { return Vec2(at + lines[k] - '0', lines[k + 1] - '0'); };
      if (lines[i + 2] != ' ' && lines[i + 3] != ' ') strokes.push_back({position(i), position(i + 2)});
      ++i;
    }
    at += lines[0] - '0' + space;
  }
  const Vec2 middle((at - space) / 2, height / 2);
  for (Stroke& stroke : strokes)
    for (Vec2& end : stroke) end = (end - middle) / height;
  return strokes;
}

}  // namespace tack
