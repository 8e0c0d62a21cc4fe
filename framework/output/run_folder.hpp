// The folder of a run's results. Results are never destroyed: create() moves the folder of an
// earlier run to <name>.1, .2, ... The hidden file .tack_run, written first, marks a folder as a
// run's. While a RunFolder or a copy lives, no other process can open the folder (folder_lock.hpp).
// Errors: InputError with the folder.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "framework/output/folder_lock.hpp"

namespace tack {

class RunFolder {
 public:
  // Makes the folder; frames/, checkpoints/ and problems/ are made on first use. Throws for a
  // folder with other contents than a run, a file of that name, and a folder that is or contains
  // the working directory. root() is absolute and without links.
  static RunFolder create(const std::filesystem::path& root);

  // Opens the folder of an earlier run, to resume it.
  static RunFolder open(const std::filesystem::path& root);

  // Returns results/<scene name>, with special characters of shells and file systems replaced by
  // '_'.
  static std::filesystem::path default_root(std::string_view scene_name);
  // Returns `output`, or the default if it is empty.
  static std::filesystem::path chosen_root(const std::string& output, std::string_view scene_name);

  const std::filesystem::path& root() const { return root_; }
  std::filesystem::path scene() const { return root_ / "scene.yaml"; }
  std::filesystem::path pvd() const { return root_ / "run.pvd"; }
  std::filesystem::path steps() const { return root_ / "steps.csv"; }
  std::filesystem::path stages() const { return root_ / "stages.csv"; }    // of protocols
  std::filesystem::path profile() const { return root_ / "profile.csv"; }  // of `tack profile`
  std::filesystem::path probes() const { return root_ / "probes.csv"; }
  // Gradients of probes, if requested.
  std::filesystem::path gradients() const { return root_ / "gradients.csv"; }
  std::filesystem::path laws() const { return root_ / "laws.csv"; }  // of adhesive pairs
  // Curves that expectations compare with.
  std::filesystem::path measured() const { return root_ / "measured.csv"; }
  std::filesystem::path summary() const { return root_ / "summary.json"; }
  std::filesystem::path log() const { return root_ / "log.txt"; }
  std::filesystem::path frames() const { return root_ / "frames"; }
  std::filesystem::path checkpoints() const { return root_ / "checkpoints"; }
  std::filesystem::path problems() const { return root_ / "problems"; }

  // frames/frame_000012.vtu, relative to root().
  static std::filesystem::path frame(int number);

  // Path that create() moved the earlier run to, if there was one.
  const std::optional<std::filesystem::path>& moved_aside() const { return moved_aside_; }

 private:
  explicit RunFolder(std::filesystem::path root) : root_(std::move(root)) {}

  std::filesystem::path root_;
  std::optional<std::filesystem::path> moved_aside_;
  std::shared_ptr<FolderLock> lock_;
};

}  // namespace tack
