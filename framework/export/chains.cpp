#include "framework/export/chains.hpp"

#include <algorithm>

namespace tack {
namespace {

class ChainFinder {
 public:
  explicit ChainFinder(const std::vector<Edge>& edges) : edges_(edges), used_(edges.size(), 0) {
    int count = 0;
    for (const Edge& e : edges) count = std::max({count, e[0] + 1, e[1] + 1});
    edges_at_.resize(count);
    for (size_t e = 0; e < edges.size(); ++e)
      for (const int v : edges[e]) edges_at_[v].push_back(static_cast<int>(e));
  }

  std::vector<std::vector<int>> find() {
    // Open chains begin where other than two edges meet; what is left then are closed ones.
    for (const bool closed : {false, true})
      for (size_t e = 0; e < edges_.size(); ++e)
        for (const int v : edges_[e])
          if (!used_[e] && (closed || edges_at_[v].size() != 2)) follow(v, static_cast<int>(e));
    return std::move(chains_);
  }

 private:
  void follow(int vertex, int edge) {
    std::vector<int>& chain = chains_.emplace_back(1, vertex);
    while (edge >= 0) {
      used_[edge] = 1;
      vertex = edges_[edge][edges_[edge][0] == vertex ? 1 : 0];
      chain.push_back(vertex);
      edge = -1;
      if (edges_at_[vertex].size() == 2)
        for (const int next : edges_at_[vertex])
          if (!used_[next]) edge = next;
    }
  }

  const std::vector<Edge>& edges_;
  std::vector<char> used_;
  std::vector<std::vector<int>> edges_at_;
  std::vector<std::vector<int>> chains_;
};

}  // namespace

std::vector<std::vector<int>> chains_of(const std::vector<Edge>& edges) { return ChainFinder(edges).find(); }

}  // namespace tack
