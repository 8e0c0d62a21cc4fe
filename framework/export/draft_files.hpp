// Files that grow piece by piece and appear under their names once all of them are complete. None
// stays open between pieces, so their number is not limited.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace tack {

class DraftFiles {
 public:
  DraftFiles() = default;
  ~DraftFiles();  // removes drafts that were not committed
  DraftFiles(const DraftFiles&) = delete;
  DraftFiles& operator=(const DraftFiles&) = delete;

  // Begins a file and returns its number. Makes its folder if that is missing. Throws InputError.
  int begin(const std::filesystem::path& path);
  // Appends to a file. Throws InputError if it cannot be written.
  void append(int file, std::string_view bytes);
  // Appends the content of another draft, which is dropped. Throws InputError.
  void append_draft(int file, int other);
  // Removes a draft.
  void drop(int file);
  // Gives all files their names. Throws InputError.
  void commit();

 private:
  std::vector<std::filesystem::path> paths_;  // empty: dropped
};

}  // namespace tack
