#include "framework/motion/motion.hpp"

namespace tack {

void Motion::fields(Fields& f) {
  f.component("select", select_, "vertices whose motion is prescribed");
  f.text("carrier", carrier_, "object with a prescribed rigid motion that carries these vertices; their own motion is relative to it");
  f.number("from", from_, units::time, "start of the motion; the vertices are free before").nonnegative();
  f.optional_number("until", until_, units::time,
                    "end of the motion; the vertices are free afterwards and keep their velocity; never unless given");
  f.optional_vector("along", along_, units::none,
                    "prescribes only the component along this direction; the vertices are free perpendicular to it "
                    "(a roller, a plane of symmetry). Vertices that another motion prescribes in all components are "
                    "skipped");
  f.optional_vector("across", across_, units::none,
                    "prescribes only the components perpendicular to this direction; the vertices are free along it (a slider)");
  f.check("carrier", [this]() -> std::string { return carrier_.empty() || !partial() ? "" : "moves vertices that are fixed in all directions; remove `along` or `across`"; });
  for (const char* key : {"along", "across"})
    f.check(key, [this]() -> std::string {
      if (along_ && across_) return "give either along or across";
      return (along_ && along_->norm() == 0) || (across_ && across_->norm() == 0) ? "must not be zero" : "";
    });
  f.check("until", [this]() -> std::string {
    return until() > from_ ? "" : "must be later than from";
  });
}

Mat3 Motion::fixed_directions() const {
  if (along_) return along_->normalized() * along_->normalized().transpose();
  if (across_) return Mat3::Identity() - across_->normalized() * across_->normalized().transpose();
  return Mat3::Identity();
}

namespace {

class Fixed : public Motion {
 public:
  void set_positions(std::span<const int> vertices, const VecX&, const VecX& reference, double,
             VecX& x) const override {
    for (const int v : vertices) vertex(x, v) = vertex(reference, v);
  }
  bool moves() const override { return false; }
  std::optional<RigidMap> pose(double) const override { return RigidMap{}; }
};

TACK_REGISTER(Motion, Fixed, "fixed", "Vertices that do not move and own no degrees of freedom.", "");

}  // namespace
}  // namespace tack
