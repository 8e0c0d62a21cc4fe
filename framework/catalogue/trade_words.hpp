// Words of the field and of other programs, and where scenes, commands and pages have them. The one
// place of these words: `tack list WORD` searches them.
#pragma once

#include <span>
#include <string_view>

namespace tack {

struct TradeWord {
  // Words that stand for the same thing, separated by commas: "cohesive zone, cohesive element".
  std::string_view words;
  std::string_view about;  // what tack has for them, in a few words
  // Separated by commas: a component ("adhesion bilinear"), a kind ("motion"), a key of scenes
  // ("contact.friction.mu") or a command ("tack calibrate"). Empty: tack has nothing of the kind.
  std::string_view see;
  std::string_view page;  // "docs/scenes.md#friction", or without an anchor
};

std::span<const TradeWord> trade_words();

}  // namespace tack
