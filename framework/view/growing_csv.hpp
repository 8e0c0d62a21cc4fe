// A table (output/csv.hpp) that another process or thread is writing, read incrementally.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tack {

class GrowingCsv {
 public:
  explicit GrowingCsv(std::filesystem::path path) : path_(std::move(path)) {}

  // Reads the rows added since the last call. A replaced or shorter file begins a new generation.
  void update();
  int generation() const { return generation_; }
  const std::vector<std::string>& columns() const { return columns_; }  // empty: no table yet
  int rows() const { return static_cast<int>(starts_.size()); }         // complete rows

  // Returns at most `most` of the rows from `from` on, evenly spread, including the last; NaN for
  // cells that are no number.
  std::vector<std::vector<double>> rows(int from, int most) const;

 private:
  void reset();

  std::filesystem::path path_;
  int generation_ = 0;
  // Identity of the file, and the bytes read so far.
  std::uint64_t file_ = 0, device_ = 0, end_ = 0;
  std::vector<std::string> columns_;
  std::vector<std::uint64_t> starts_;  // byte offsets of the rows
};

}  // namespace tack
