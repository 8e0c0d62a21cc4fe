#include "framework/core/history.hpp"

#include <stdexcept>

namespace tack {

const std::vector<double>* history_values(const History& history, const std::string& name, int width, int entries) {
  const auto found = history.find(name);
  if (found == history.end()) return nullptr;
  const HistoryArray& array = found->second;
  if (array.width != width || array.values.size() != static_cast<size_t>(width) * entries)
    throw std::logic_error("the history '" + name + "' has another shape");
  return &array.values;
}

}  // namespace tack
