// An interaction of the scene as built in its world.
#pragma once

#include <string>
#include <vector>

namespace tack {

class Term;

struct ActingInteraction {
  // A history array declared by InteractionBuilder::add_history.
  struct HistoryShape {
    std::string name;
    int width, entries;
  };

  std::string name, type;
  std::vector<int> bodies;  // ascending
  std::vector<const Term*> terms;
  std::vector<HistoryShape> history;
};

}  // namespace tack
