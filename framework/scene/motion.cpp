#include "framework/scene/motion.hpp"

namespace tack {

void Motion::fields(Fields& f) {
  f.component("select", select_, "the vertices it holds");
  f.number("from", from_, units::time, "when it seizes them; they are free before").nonnegative();
  f.optional_number("until", until_, units::time,
                    "when it lets go of them, with the velocity they have; never unless given");
  f.check("until", [this]() -> std::string {
    return until() > from_ ? "" : "must be later than from";
  });
}

namespace {

class Fixed : public Motion {
 public:
  void place(std::span<const int> vertices, const VecX&, const VecX& anchor, double,
             VecX& x) const override {
    for (const int v : vertices) vertex(x, v) = vertex(anchor, v);
  }
  bool moves() const override { return false; }
};

TACK_REGISTER(Motion, Fixed, "fixed", "Vertices that do not move and own no unknowns.", "");

}  // namespace
}  // namespace tack
