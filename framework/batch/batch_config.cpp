#include "framework/batch/batch_config.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "framework/batch/results_table.hpp"
#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/experiment/file_kind.hpp"

namespace tack {
namespace {

template <class T, class Name>
std::string twice(const std::vector<T>& list, const char* what, const Name& name) {
  std::set<std::string> names;
  for (const T& entry : list)
    if (!names.insert(name(entry)).second) return fmt::format("two {} are named '{}'; give them names that differ", what, name(entry));
  return "";
}

}  // namespace

void BatchBase::fields(Fields& f) {
  f.text("name", name, "name in tables; the file's name unless given").line();
  f.path("file", file, "an experiment").required();
  f.texts("set", set, "overrides of this one, as `time.step=1 ms`");
}

void BatchStatistic::fields(Fields& f) {
  f.text("name", name, "column of results.csv; made from the other keys if empty").line();
  SpecifiedStatistic::fields(f);
}

std::string BatchStatistic::column() const { return name.empty() ? description() : name; }

void SlurmConfig::fields(Fields& f) {
  f.text("partition", partition, "partition; the cluster's default unless given").line();
  f.text("account", account, "account that is charged").line();
  f.number("time", time, units::time, "time limit of a case; a case of more than two minutes is asked to end a minute before").positive();
  f.integer("at_once", at_once, "largest number of concurrent cases; 0: no limit").at_least(0);
  f.integer("requeues", requeues,
            "how often a case that reaches its time limit is queued again (batches), to go on from its newest checkpoint; "
            "needs output.checkpoint_interval and a time limit above two minutes").at_least(0);
  f.integer("max_array_size", max_array_size, "most tasks of one job array; 0: the cluster's MaxArraySize").at_least(0);
  f.texts("prologue", prologue, "lines of shell that each task runs first, as `module load openblas`").line();
  f.texts("options", options, "further options of sbatch, as `--constraint=fast`").line();
  f.check("requeues", [this]() -> std::string {
    if (requeues > 0 && whole_minutes(time) <= 2) return "a case is asked to end a minute before its time limit only if `time` exceeds 2 min";
    return "";
  });
}

long whole_minutes(double seconds) { return std::lround(std::ceil(seconds / 60)); }

void BatchConfig::fields(Fields& f) {
  f.text("name", name, "name of the results folder").required().line();
  f.text("about", about, "purpose of the batch");
  f.path("base", base, "the scene that is varied");
  f.list("bases", bases, "several scenes, each of which is varied");
  f.texts("set", set, "overrides of all cases, as `output.frames=false`");
  f.component_list("vary", vary, "variations; with several entries, all combinations of them");
  f.list("statistics", statistics,
         "statistics of probes, one column of results.csv each; without any, final, min and max of all probes");
  f.choice("table", table,
           {{"csv", BatchTable::csv, "results.csv alone"},
            {"hdf5", BatchTable::hdf5, "results.h5 as well: typed columns with units, for many cases and for pandas, h5py or MATLAB"}},
           "format of the table");
  f.list("plots", plots, "pictures that `tack plot` draws in addition to its own");
  f.integer("threads", threads, "threads per case").at_least(1);
  f.integer("jobs", jobs, "concurrent cases; 0: as many as cores allow").at_least(0);
  f.optional_number("memory", memory, units::none,
                    "memory limit of a case in GB; a case that needs more fails. Without it, no case starts while memory is short").positive();
  f.optional_number("time_limit", time_limit, units::time, "wall time of a case, after which it is stopped and counts as failed").positive();
  f.object("slurm", slurm, "resources that `--slurm` requests");
  f.check("base", [this]() -> std::string {
    if (base.empty() && bases.empty()) return "give an experiment (base), or several (bases)";
    if (!base.empty() && !bases.empty()) return "either base or bases, not both";
    return "";
  });
  f.check("bases", [this] { return twice(all_bases(), "bases", [](const BatchBase& b) { return b.name; }); });
  f.check("plots", [this]() -> std::string {
    std::vector<std::string> names;
    for (const BatchBase& b : all_bases()) names.push_back(b.name);
    for (const BatchPlot& p : plots)
      if (std::string wrong = unknown_base(p, names); !wrong.empty()) return wrong;
    return twice(plots, "plots", [](const BatchPlot& p) { return p.name; });
  });
  f.check("statistics", [this]() -> std::string {
    for (const BatchStatistic& s : statistics)
      if (is_reserved_column(s.column())) return fmt::format("results.csv has a column '{}' already; give this statistic another name", s.column());
    return twice(statistics, "statistics", [](const BatchStatistic& s) { return s.column(); });
  });
}

std::vector<BatchBase> BatchConfig::all_bases() const {
  std::vector<BatchBase> all = bases;
  if (!base.empty()) all.push_back({"", base, {}});
  for (BatchBase& b : all)
    if (b.name.empty()) b.name = std::filesystem::path(b.file).stem();
  return all;
}

BatchConfig load_batch(const std::string& path, const std::vector<std::string>& overrides) {
  Value root = parse_file(path);
  for (const std::string& assignment : overrides) apply_override(root, assignment);
  refuse_other_kind(root, FileKind::batch);
  BatchConfig config;
  bind(root, config, "the batch");
  return config;
}

}  // namespace tack
