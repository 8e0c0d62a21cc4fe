// Base of the formats that are made from the shapes of a run.
#pragma once

#include "framework/export/run_shapes.hpp"
#include "framework/output/output_format.hpp"

namespace tack {

class ShapeFormat : public OutputFormat {
 public:
  void fields(Fields& f) override;  // objects, from, to, fps; derived classes add theirs
  void check_objects(const std::vector<std::string>& names) const override;
  Exported write(const std::filesystem::path& results,
                 const std::filesystem::path& output) const final;

 protected:
  // Returns the file or folder below `export` that is written unless another is given.
  virtual std::string default_output(const std::string& run) const = 0;
  // Returns true if the output is one file, false if it is a folder of files.
  virtual bool writes_one_file() const { return false; }
  // Throws InputError if the path cannot be that of an output.
  virtual void check_output(const std::filesystem::path&) const {}
  // Writes the run. Appends remarks to `notes`.
  virtual void write_run(const RunShapes& run, const std::filesystem::path& output,
                         std::vector<std::string>& notes) const = 0;

 private:
  ShapeSelection selection_;
};

// `unit`, the length that coordinates of a format without units are given in.
struct OutputUnit {
  std::string name = "m";
  void fields(Fields& f);
  double per_metre() const;  // 1000 for mm
  // Appends a remark for objects from files in another unit.
  void note_other_units(const RunShapes& run, std::vector<std::string>& notes) const;
};

}  // namespace tack
