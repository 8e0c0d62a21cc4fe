// A folder with the tiny scene and a batch of it, for tests of the whole program.
#pragma once

#include <string>

#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

namespace tack {

// 12 cases of 30 steps, that keep checkpoints.
inline const std::string steps_batch = R"(name: steps
base: tiny.yaml
set: [time.duration=0.3 s, output.checkpoint_interval=0.05 s, output.frames=false]
vary:
  - type: grid
    keys:
      objects.block.energies.0.young: {values: [1 MPa, 2 MPa, 4 MPa], as: young}
      contact.friction: {values: [{mu: 0.1}, {mu: 0.4}], as: friction}
  - {type: repeat, count: 2}
)";

// The files tiny.yaml and batch.yaml.
struct BatchFiles {
  TemporaryFolder folder;
  std::filesystem::path path = folder.path();
  explicit BatchFiles(const std::string& batch) {
    write_file(path / "tiny.yaml", tiny_scene);
    write_file(path / "batch.yaml", batch);
  }
};

}  // namespace tack
