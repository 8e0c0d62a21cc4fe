// The scene of a case with every key, and the checksum that identifies the case.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/batch/variation.hpp"
#include "framework/experiment/load_experiment.hpp"

namespace tack {

struct ResolvedCase {
  LoadedExperiment loaded;
  Value resolved;     // with units as comments
  std::string scene;  // the scene as YAML
  // Checksum of the scene, the files that it reads, the program and its libraries.
  std::string digest;
};

class CaseResolver {
 public:
  // `program`: digest of the program (program_digest()).
  explicit CaseResolver(std::string program) : program_(std::move(program)) {}

  // Sets the keys and resolves the scene. Throws InputError with file, line and remedy.
  ResolvedCase resolve(Value root, const std::vector<Variant::Setting>& set);

 private:
  const std::string& digest_of_file(const std::string& name);

  std::string program_;
  std::map<std::string, std::string> files_;  // checksums; each file is read once
};

// Returns the sizes and checksums of the running program and of those of its libraries that are
// built: mesher, mesh reader, further components.
std::string program_digest();

}  // namespace tack
