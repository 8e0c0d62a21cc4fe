// Typed scene: objects, and actions on and between them. It is part of a file that can be run
// (framework/experiment/experiment.hpp); build_world.hpp makes a world of it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/body/rod_section.hpp"
#include "framework/bond/environment.hpp"
#include "framework/config/field.hpp"
#include "framework/contact/contact_model.hpp"
#include "framework/contact/normal_law.hpp"
#include "framework/motion/motion.hpp"
#include "framework/protocol/protocol_config.hpp"
#include "framework/scene/attachment.hpp"
#include "framework/scene/body_model.hpp"
#include "framework/scene/damping_config.hpp"
#include "framework/scene/energy.hpp"
#include "framework/scene/fill.hpp"
#include "framework/scene/friction_config.hpp"
#include "framework/scene/interaction.hpp"
#include "framework/scene/remesh_config.hpp"
#include "framework/scene/start_config.hpp"
#include "framework/shapes/mesh_placement.hpp"
#include "framework/shapes/shape_source.hpp"
#include "framework/world/load.hpp"

namespace tack {

// A selection that `{type: tag, name: ...}` refers to like a group of a mesh file.
struct NamedSelection {
  std::string name;
  std::unique_ptr<Selection> select;
  void fields(Fields& f);
};

// A contact surface finer than that of the mesh.
struct SurfaceConfig {
  double edge_length = 0;  // m
  void fields(Fields& f);
};

// Data of shells, used by energies of triangles.
struct ShellConfig {
  double thickness = 0;  // m
  void fields(Fields& f);
};

struct ObjectConfig {
  std::string name;
  std::vector<std::string> groups;  // groups that it belongs to
  std::unique_ptr<ShapeSource> shape;
  MeshPlacement placement;
  Elements elements = Elements::linear;
  std::optional<FillConfig> fill;  // none once the scene is loaded: copies have replaced the entry
  std::vector<NamedSelection> selections;
  std::optional<SurfaceConfig> surface;
  std::optional<ShellConfig> shell;
  std::optional<RodConfig> rod;
  std::optional<ParticleConfig> particle;
  double contact_offset = 0;        // m
  std::optional<double> friction;   // coefficient of its surface
  std::optional<Vec3> grain;        // direction of its surface at rest
  std::unique_ptr<BodyModel> body;  // null: vertices are free
  std::vector<std::unique_ptr<Energy>> energies;
  std::optional<DampingConfig> damping;
  std::optional<RemeshConfig> remesh;  // none: elements are kept
  std::vector<std::unique_ptr<Motion>> motion;
  std::vector<AttachConfig> attach;
  std::vector<std::unique_ptr<Load>> loads;
  Vec3 velocity = Vec3::Zero();  // m/s
  Vec3 spin = Vec3::Zero();      // rad/s
  void fields(Fields& f);
};

// One side of a pair.
struct PairSide {
  std::string object;                 // name of an object or group, or "*"
  std::unique_ptr<Selection> select;  // null: the whole object
  void fields(Fields& f);
  std::string text() const;  // for messages
};

struct PairConfig {
  enum class Bonding { automatic, at_start, on_contact, first_contact };
  enum class Unstressed { as_bonded, touching };
  std::vector<PairSide> between;
  bool contact = true;
  std::unique_ptr<BarrierLaw> barrier;
  std::unique_ptr<AdhesionLaw> adhesion;
  std::optional<FrictionConfig> friction;
  std::optional<TangentialAdhesionConfig> tangential_adhesion;
  Bonding bond = Bonding::automatic;
  std::optional<double> bond_distance;  // m
  std::optional<double> bond_pressure;  // Pa
  Unstressed unstressed = Unstressed::as_bonded;
  std::string integrate = "automatic";
  std::string drive;   // of a protocol: factor of the adhesion; empty: none
  bool bonds() const;  // true if its adhesion is by bonds
  void fields(Fields& f);
};

struct ContactConfig {
  // Deprecated choices, which stand for models: pair for ipc, clipped for clipped.
  enum class Weights { area, pair };
  enum class Integral { lagged, clipped };
  double contact_distance = 1e-3;        // m
  std::optional<double> safety_barrier;  // range of safety barriers, in contact distances
  std::unique_ptr<ContactModel> model = Registry<ContactModel>::make("area_integral");
  Weights weights = Weights::area;
  Integral integral = Integral::lagged;
  bool between_prescribed = true;
  std::unique_ptr<BarrierLaw> barrier = Registry<BarrierLaw>::make("clamped_log");
  std::optional<double> overclosure_adjustment;  // m
  std::optional<FrictionConfig> friction;
  FrictionBlend blend = FrictionBlend::geometric;
  LaggingConfig lagging;
  std::vector<PairConfig> pairs;
  void fields(Fields& f);

 private:
  std::string replace_model(const char* name);
};

struct SceneConfig {
  Vec3 gravity = Vec3::Zero();  // m/s^2
  std::vector<ObjectConfig> objects;
  std::vector<NamedSelection> selections;
  std::vector<std::unique_ptr<Interaction>> interactions;
  std::optional<ContactConfig> contact;
  std::vector<ProtocolConfig> protocols;
  std::optional<Environment> environment;
  std::optional<StartConfig> start;
  void fields(Fields& f);
};

}  // namespace tack
