#include "framework/output/output_config.hpp"

#include <set>

namespace tack {

void OutputConfig::fields(Fields& f) {
  f.flag("frames", frames, "write frames/*.vtu and run.pvd");
  f.number("frame_interval", frame_interval, units::time, "time between frames; 0: every step").nonnegative();
  f.optional_number("checkpoint_interval", checkpoint_interval, units::time,
                    "simulated time between checkpoints, which `tack run --resume` goes on from; none unless given")
      .positive();
  f.texts("fields", frame_fields, "vertex fields of the frames: velocity, contact_force, adhesion_force, "
                                  "friction_force (with tangential adhesion), displacement, mass; and of elements: von_mises_stress (of the Cauchy "
                                  "stress of all energies of the element; of sheets, in their middle), plastic_strain (accumulated), not a number where an "
                                  "object has none");
  f.check("fields", [this]() -> std::string {
    static const std::set<std::string> known = {"velocity", "contact_force", "adhesion_force", "friction_force",
                                                "displacement", "mass", "von_mises_stress", "plastic_strain"};
    for (const auto& field : frame_fields)
      if (!known.count(field))
        return "unknown field '" + field + "'; choose from velocity, contact_force, adhesion_force, friction_force, displacement, "
               "mass, von_mises_stress, plastic_strain";
    return "";
  });
}

}  // namespace tack
