// A table (output/csv.hpp) that is being written: what is there of it so far, without reading all of it again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tack {

class GrowingCsv {
 public:
  explicit GrowingCsv(std::filesystem::path path) : path_(std::move(path)) {}

  // Finds what has been added; another file of that name, or a shorter one, is another generation of it.
  void look();
  int generation() const { return generation_; }
  const std::vector<std::string>& columns() const { return columns_; }  // empty: there is no table yet
  int rows() const { return static_cast<int>(starts_.size()); }         // complete ones

  // So many of the rows from the given one on, evenly spread, the last among them; NaN for a cell that is no number.
  std::vector<std::vector<double>> rows(int from, int most) const;

 private:
  void forget();

  std::filesystem::path path_;
  int generation_ = 0;
  std::uint64_t file_ = 0, device_ = 0, end_ = 0;  // which it is, and up to which byte it is known
  std::vector<std::string> columns_;
  std::vector<std::uint64_t> starts_;  // of the rows [bytes]
};

}  // namespace tack
