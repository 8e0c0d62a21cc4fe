// vtu: the frames that a run writes itself (vtu.hpp).
#include <fmt/format.h>

#include "framework/output/output_format.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

class VtuFormat : public OutputFormat {
 public:
  Exported write(const std::filesystem::path& results, const std::filesystem::path& output) const override {
    if (!output.empty())
      throw InputError(fmt::format("{}: frames are vtu as they are; open {} in ParaView, and copy the folder {} to have them elsewhere", output.string(),
                                   (results / "run.pvd").string(), (results / "frames").string()));
    return {};
  }
};
TACK_REGISTER(OutputFormat, VtuFormat, "vtu", "Frames for ParaView: vertices, elements and all fields, one file each, and run.pvd, which lists them.", "");

}  // namespace
}  // namespace tack
