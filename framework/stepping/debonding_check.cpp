#include "framework/stepping/debonding_check.hpp"

#include "framework/core/debonding.hpp"
#include "framework/core/term.hpp"

namespace tack {

int DebondingCheck::find(const VecX& x, const VecX& y) const {
  std::vector<char> marks(world_.dofs.vertex_count(), 0);
  for (const Term* term : world_.terms) term->mark_debonding(x, y, marks);
  for (size_t body = 0; body < world_.bodies.size(); ++body) {
    int adhering = 0, over = 0;
    for (const int v : world_.vertices_of(static_cast<int>(body))) {
      adhering += (marks[v] & adheres) != 0;
      over += (marks[v] & passes_over) != 0;
    }
    if (over > share_max * adhering) return static_cast<int>(body);
  }
  return -1;
}

}  // namespace tack
