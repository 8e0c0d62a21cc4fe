// Every probe, energy and field before the first step, under every load and interaction, with every
// integrator and stepper.
#include <catch2/catch.hpp>

#include <algorithm>

#include "framework/output/element_fields.hpp"
#include "framework/output/frame_fields.hpp"
#include "framework/output/frame_geometry.hpp"
#include "framework/output/probe_set.hpp"
#include "framework/world/energy_records.hpp"
#include "framework/world/load.hpp"
#include "geometry/errors.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

const std::string damping = "    damping: {mass: 1 1/s, stiffness: 1 ms}\n";
const std::string protocol = "protocols: [{name: test, stages: [{name: wait}]}]\n";
const std::string of_damping = "  - {name: n, type: force, on: soft, of: damping}\n";

const std::string objects = R"(
gravity: [0, -9.81, 0]
contact: {distance: 1 mm, pairs: [{between: [soft, table], friction: {mu: 0.3}, adhesion: {type: rcc, work_of_adhesion: 0.1, normal_stiffness: 1e7}}]}
objects:
  - {name: table, shape: {type: box, size: [1, 0.1, 1]}, place: {translate: [0, -0.0506, 0]}, motion: [fixed]}
  - name: soft
    shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}
    place: {translate: [0, 0.05, 0]}
    velocity: [0.1, 0, 0.2]
    energies: [{type: von_mises, young: 1 MPa, yield_stress: 1 kPa, viscosity: 1 Pa s}]
)" + damping + R"(    motion: [{type: fixed, select: {type: face, direction: [1, 0, 0]}}]
    loads:
      - {type: pressure, name: push, value: 1 kPa, select: {type: face, direction: [0, 1, 0]}}
      - {type: torque, value: 0.1, axis: [1, 0, 0]}
      - {type: wind, velocity: [0, 2, 1]}
      - {type: field, x: 1 - vx - x * 100, y: t}
      - {type: traction, value: [0, 1 Pa, 0], select: {type: face, direction: [0, 1, 0]}}
      - {type: force, value: [0, 1 mN, 0], select: {type: face, direction: [0, 1, 0]}}
      - {type: body_force, value: [0, 0, 1]}
  - name: balloon
    shape: {type: sphere, radius: 0.1, cells: 2, surface: true}
    place: {translate: [0.5, 0.5, 0]}
    shell: {thickness: 1 mm}
    energies: [{type: neo_hookean_membrane, young: 1 MPa, density: 1000}]
    loads: [{type: chamber, name: air, content: {type: gas, pressure: 1 kPa, ambient: 0}}]
  - name: ball
    shape: {type: sphere, radius: 0.1, cells: 2, surface: true}
    place: {translate: [-0.5, 0.5, 0]}
    shell: {thickness: 1 mm}
    energies: [{type: neo_hookean_membrane, young: 1 MPa, density: 1000}]
  - {name: door, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 0.5, 0]}, body: {type: affine, density: 1000}, spin: [0, 1, 0]}
  - {name: cart, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 0.8, 0]}, body: {type: affine, density: 1000}, velocity: [1, 0, 0]}
  - {name: bob, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 1.1, 0]}, body: {type: affine, density: 1000}}
  - {name: cap, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 1.4, 0]}, body: {type: affine, density: 1000}}
interactions:
  - {type: hinge, name: pin, object: door, at: [0, 0.5, 0], axis: [0, 1, 0], friction: {torque: 0.01}, damping: 0.1, motor: {speed: 1 rad/s, torque: 0.1}}
  - {type: slider, name: rail, object: cart, at: [0, 0.8, 0], axis: [1, 0, 0], friction: {force: 0.1}, damping: 0.1, position_motor: {way: 0.1, force: 1}}
  - {type: ball, name: socket, object: bob, at: [0, 1.2, 0]}
  - {type: weld, name: glue, object: cap, at: [0, 1.4, 0]}
  - {type: rope, name: line, from: {object: bob, at: [0, 1.1, 0]}, to: {at: [0.3, 1.1, 0]}, stiffness: 100, length: 0.2}
  - {type: spring, name: coil, from: {object: bob}, to: {object: cap}, stiffness: 10, length: 0.1}
  - {type: chamber, name: gas, parts: [{object: ball}], content: {type: gas, pressure: 2 kPa, ambient: 0}}
)";

const std::string probes = R"(
probes:
  - {name: a, type: reaction, object: soft, select: {type: face, direction: [1, 0, 0]}}
  - {name: b, type: torque, object: soft, select: {type: face, direction: [1, 0, 0]}}
  - {name: c, type: reaction, object: table}
  - {name: d, type: contact_force, on: soft, from: table}
  - {name: e, type: friction_force, on: soft, from: table}
  - {name: f, type: contact_area, between: [soft, table]}
  - {name: g, type: bonds, between: [soft, table], quantity: opening}
  - {name: h, type: attached_objects, to: table}
  - {name: i, type: centre_of_mass, object: door}
  - {name: j, type: chamber, chamber: air}
  - {name: k, type: chamber, chamber: push}
  - {name: l, type: energy}
  - {name: m, type: energy, term: dissipated}
)" + of_damping + R"(  - {name: o, type: force, on: soft, of: bonds}
  - {name: p, type: formula, of: l + m}
  - {name: q, type: gap, between: [soft, table]}
  - {name: r, type: intact_springs, interaction: coil}
  - {name: s, type: spring_force, interaction: coil}
  - {name: t, type: joint_angle, interaction: pin}
  - {name: u, type: joint_error, interaction: rail}
  - {name: v, type: joint_force, interaction: socket}
  - {name: w, type: joint_torque, interaction: pin}
  - {name: x, type: joint_way, interaction: rail}
  - {name: y, type: motor_torque, interaction: pin}
  - {name: z, type: motor_force, interaction: rail}
  - {name: aa, type: rope_force, interaction: line}
  - {name: ab, type: objects_within, of: bob, min: [-1, -1, -1], max: [2, 2, 2]}
  - {name: ac, type: separation, from: {object: bob}, to: {object: cap}}
  - {name: ad, type: sliding_speed, between: [soft, table]}
)";

std::string without(std::string scene, const std::string& line) { return scene.erase(scene.find(line), line.size()); }

void ask_all(TestRun& run) {
  World& world = *run.world;
  if (world.contact) world.contact->move_to(run.state().x);
  ProbeSet set = probes_of(run.simulation.built());
  const std::vector<double> values = set.sample(world, run.state());
  for (size_t i = 0; i < values.size(); ++i) {
    INFO(set.columns()[i]);
    CHECK(std::isfinite(values[i]));
  }
  for (const NamedEnergy& energy : energies_by_term(world, run.state())) {
    INFO(energy.name);
    CHECK(std::isfinite(energy.value));
  }
  const FrameGeometry geometry = frame_geometry(world);
  for (const FrameFieldInfo& info : frame_fields())
    if (info.of_elements) element_fields({info.name}, world, run.state().x, geometry);
    else vertex_fields({info.name}, world, run.state(), geometry);
}

template <class Base>
void require_all_in(const std::string& scene) {
  for (const std::string& name : Registry<Base>::kind().names()) {
    if (name.starts_with("documented_") || name.starts_with("test_")) continue;  // of other tests
    INFO(Base::kind_name << " " << name << ": add one to the scene of this test");
    CHECK(contains(scene, "{type: " + name) + contains(scene, ", type: " + name) > 0);
  }
}

}  // namespace

TEST_CASE("every probe, energy and field has a value before the first step, with every load and interaction", "[probes]") {
  require_all_in<Load>(objects);
  require_all_in<Interaction>(objects);
  const std::vector<std::string> appended = {"step", "stage"};
  for (const std::string& name : Registry<Probe>::kind().names())
    if (std::find(appended.begin(), appended.end(), name) == appended.end()) CHECK(contains(probes, "type: " + name));
  int runs = 0;
  for (const std::string& stepper : Registry<Stepper>::kind().names())
    for (const ComponentVariant& integrator : variants<TimeIntegrator>()) {
      INFO(stepper << ", " << integrator.yaml);
      const std::string time = "time: {step: 10 ms, duration: 1, stepper: " + stepper + ", integrator: " + integrator.yaml + "}\n";
      const std::string step = stepper == "lcp_pgs" ? "  - {name: ae, type: step, figure: sweeps}\n" : "";
      const bool staged = stepper != "path_following";
      const std::string stage = staged ? "  - {name: af, type: stage}\n" + protocol : "";
      std::optional<TestRun> run;
      try {
        // Nothing has a velocity that could be damped in quasi-static steps.
        run.emplace(time + (integrator.type == "quasi_static" ? without(objects, damping) + without(probes, of_damping) : objects + probes) + step + stage);
      } catch (const InputError& error) {
        INFO(error.what());
        CHECK(stepper != "incremental_potential");
        continue;
      }
      ++runs;
      ask_all(*run);
      run->simulation.start_from(run->state());
      ask_all(*run);
    }
  CHECK(runs >= 5);
}

TEST_CASE("loads act at the start of a quasi-static run as in its steps", "[probes]") {
  const std::string top = "{type: face, direction: [0, 1, 0]}";
  TestRun run("time: {step: 0.5, duration: 1, integrator: quasi_static}\nobjects:\n"
              "  - {name: a, shape: {type: box, size: [0.1, 0.1, 0.1]}, energies: [{type: neo_hookean, young: 1 MPa}],\n"
              "     motion: [{type: fixed, select: " + top + "}],\n"
              "     loads: [{type: pressure, value: 1 kPa, ramp: [[0, 1], [1, 3]], select: " + top + "}]}\n"
              "probes: [{name: r, type: reaction, object: a, select: " + top + ", direction: [0, 1, 0]}]\n");
  CHECK(run.sample(0)[0] == Approx(10));
  run.step();
  CHECK(run.sample(0)[0] == Approx(20));
}

TEST_CASE("probes of friction are zero for pairs with zero friction", "[probes]") {
  const auto scene = [](const std::string& friction) {
    return "time: {step: 10 ms, duration: 1}\ngravity: [0, -9.81, 0]\ncontact: {distance: 1 mm" + friction + "}\nobjects:\n"
           "  - {name: floor, shape: {type: box, size: [1, 0.1, 1]}, place: {translate: [0, -0.0505, 0]}, motion: [fixed]}\n"
           "  - {name: a, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 0.05, 0]}, velocity: [1, 0, 0], energies: [{type: neo_hookean, young: 1 MPa}]}\n"
           "probes: [{name: f, type: friction_force, on: a, from: floor}, {name: r, type: reaction, object: floor}]\n";
  };
  TestRun run(scene(", friction: {mu: 0}"));
  for (int i = 0; i < 3; ++i) run.step();
  CHECK(run.sample(0) == std::vector<double>{0, 0, 0});
  CHECK(std::abs(run.sample(1)[0]) < 1e-3 * std::abs(run.sample(1)[1]));
  CHECK_THROWS_WITH(TestRun(scene("")), Catch::Contains("no pair has friction"));
}
