// Provenance in summary.json and compare.json.
//
// Keys: version, commit, sources (in words), changed_sources, untracked_sources (both null outside
// of git), compiler, flags, instruction_set, date (ISO 8601, UTC), host, cpu, cores,
// hardware_threads, threads, command, directory, plugins [{path, checksum (CRC-32 of the file)}].
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "framework/output/provenance.hpp"

namespace tack {

nlohmann::ordered_json to_json(const Provenance& provenance);

}  // namespace tack
