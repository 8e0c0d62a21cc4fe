#include "framework/view/growing_csv.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "framework/output/csv.hpp"
#include "framework/report/frame_series.hpp"

namespace tack {

void GrowingCsv::reset() {
  end_ = file_ = device_ = 0;
  columns_.clear();
  starts_.clear();
}

void GrowingCsv::update() {
  struct stat now {};
  if (::stat(path_.c_str(), &now) != 0) {
    if (file_ != 0) ++generation_;
    return reset();
  }
  if (file_ != 0 && (now.st_ino != file_ || now.st_dev != device_ || static_cast<std::uint64_t>(now.st_size) < end_)) {
    ++generation_;
    reset();
  }
  file_ = now.st_ino;
  device_ = now.st_dev;
  std::ifstream in(path_, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(end_));
  std::string line, head;
  while (std::getline(in, line) && !in.eof()) {
    const std::uint64_t start = end_;
    if (columns_.empty()) {
      head += (head.empty() ? "" : "\n") + line;
      end_ += line.size() + 1;
      // a name may span several lines
      if (std::count(head.begin(), head.end(), '"') % 2 == 0) columns_ = csv_cells(head);
    } else {
      starts_.push_back(start);
      end_ += line.size() + 1;
    }
  }
  if (columns_.empty()) end_ = 0;  // incomplete header
}

std::vector<std::vector<double>> GrowingCsv::rows(int from, int most) const {
  std::vector<std::vector<double>> rows;
  std::ifstream in(path_, std::ios::binary);
  for (const int i : spaced_indices(this->rows() - from, most)) {
    in.seekg(static_cast<std::streamoff>(starts_[static_cast<size_t>(from + i)]));
    std::string line;
    if (!std::getline(in, line)) break;
    std::vector<double> row;
    for (const std::string& cell : csv_cells(line)) row.push_back(csv_number(cell).value_or(std::numeric_limits<double>::quiet_NaN()));
    row.resize(columns_.size(), std::numeric_limits<double>::quiet_NaN());
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace tack
