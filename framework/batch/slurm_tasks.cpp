#include "framework/batch/slurm_tasks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "framework/batch/optional_json.hpp"
#include "framework/config/words.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

void write_tasks(const BatchFolder& folder, const std::vector<BatchCase>& cases, const BatchLimits& limits) {
  std::vector<std::string> lines;
  lines.reserve(cases.size());
  size_t length = 0;
  for (const BatchCase& one : cases) {
    const Json json{{"name", one.name}, {"digest", one.digest}, {"threads", limits.threads}, {"memory", optional_json(limits.memory)}, {"time_limit", optional_json(limits.time_limit)}};
    lines.push_back(json.dump(-1, ' ', false, Json::error_handler_t::replace));
    length = std::max(length, lines.back().size());
  }
  std::string text;
  text.reserve(lines.size() * (length + 1));
  for (const std::string& line : lines) text += line + std::string(length - line.size(), ' ') + "\n";
  replace_file(folder.tasks(), text);
}

SlurmTask read_task(const BatchFolder& folder, int number) {
  const std::string path = folder.tasks();
  std::ifstream in(path, std::ios::binary);
  std::string line;
  if (!std::getline(in, line)) throw InputError(fmt::format("{}: cannot be read; submit the cases again with --slurm, which writes it", path));
  const auto width = static_cast<std::streamoff>(line.size()) + 1;
  in.seekg(0, std::ios::end);
  const std::streamoff count = in.tellg() / width;
  if (number < 0 || number >= count) throw InputError(fmt::format("--task {}: the batch has {}, counted from 0", number, counted(static_cast<size_t>(count), "case")));
  in.seekg(number * width);
  std::getline(in, line);
  try {
    const Json json = Json::parse(line);
    SlurmTask task;
    task.one.name = json.at("name");
    task.one.digest = json.at("digest");
    task.limits = {json.at("threads"), 1, optional_number(json.at("memory")), optional_number(json.at("time_limit"))};
    return task;
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}:{}: is damaged ({}); submit the cases again with --slurm, which keeps what is done", path, number + 1, error.what()));
  }
}

}  // namespace tack
