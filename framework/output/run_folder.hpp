// The folder of a run's results. Results are never destroyed: a folder of an earlier run is moved
// aside to <name>.1, .2, ... before a new run takes its place. A folder counts as a run's by the
// hidden file .tack_run, which is written first. While a RunFolder (or a copy of it) lives, no other
// process gets one of the same folder (folder_lock.hpp).
// Errors: InputError naming the folder.
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
  // Makes the folder; frames/, checkpoints/ and problems/ are made when there is something to put
  // there. Refuses a folder that contains anything but a run, a file of that name, and the working
  // directory itself or one around it. root() is absolute and without links.
  static RunFolder create(const std::filesystem::path& root);

  // The folder of an earlier run, to go on with it.
  static RunFolder open(const std::filesystem::path& root);

  // results/<scene name>, with characters that trouble shells and file systems replaced by '_'.
  static std::filesystem::path default_root(std::string_view scene_name);
  // `output` if it is given (not empty), else the default.
  static std::filesystem::path chosen_root(const std::string& output, std::string_view scene_name);

  const std::filesystem::path& root() const { return root_; }
  std::filesystem::path scene() const { return root_ / "scene.yaml"; }
  std::filesystem::path pvd() const { return root_ / "run.pvd"; }
  std::filesystem::path steps() const { return root_ / "steps.csv"; }
  std::filesystem::path profile() const { return root_ / "profile.csv"; }  // of `tack profile`
  std::filesystem::path probes() const { return root_ / "probes.csv"; }
  std::filesystem::path gradients() const { return root_ / "gradients.csv"; }  // of probes, if the scene asks for them
  std::filesystem::path laws() const { return root_ / "laws.csv"; }  // of adhesive pairs
  std::filesystem::path measured() const { return root_ / "measured.csv"; }  // what expectations hold the run against
  std::filesystem::path summary() const { return root_ / "summary.json"; }
  std::filesystem::path log() const { return root_ / "log.txt"; }
  std::filesystem::path frames() const { return root_ / "frames"; }
  std::filesystem::path checkpoints() const { return root_ / "checkpoints"; }
  std::filesystem::path problems() const { return root_ / "problems"; }

  // frames/frame_000012.vtu, relative to root().
  static std::filesystem::path frame(int number);

  // Where create() moved the earlier run, if there was one.
  const std::optional<std::filesystem::path>& moved_aside() const { return moved_aside_; }

 private:
  explicit RunFolder(std::filesystem::path root) : root_(std::move(root)) {}

  std::filesystem::path root_;
  std::optional<std::filesystem::path> moved_aside_;
  std::shared_ptr<FolderLock> lock_;
};

}  // namespace tack
