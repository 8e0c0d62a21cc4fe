// The scene file, typed: every key with its default. Nothing is built here (build_world.hpp).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/field.hpp"
#include "framework/contact/normal_law.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/output/expectations.hpp"
#include "framework/output/probe.hpp"
#include "framework/scene/energy.hpp"
#include "framework/scene/friction_config.hpp"
#include "framework/scene/load.hpp"
#include "framework/scene/motion.hpp"
#include "framework/scene/shape_source.hpp"
#include "framework/stepping/time_integrator.hpp"

namespace tack {

struct TimeConfig {
  double step = 0.01;     // s
  double duration = 1;    // s
  std::optional<double> wall_limit;  // s of wall time
  int max_halvings = 8;
  std::unique_ptr<TimeIntegrator> integrator = Registry<TimeIntegrator>::make("implicit_euler");
  void fields(Fields& f);
};

struct PlaceConfig {
  Vec3 scale = Vec3::Ones();
  Vec3 axis = Vec3::UnitY();
  double angle = 0;               // rad
  Vec3 translate = Vec3::Zero();  // m
  void fields(Fields& f);
};

// What `{type: tag, name: ...}` refers to, as to a group of a mesh file.
struct NamedSelection {
  std::string name;
  std::unique_ptr<Selection> select;
  void fields(Fields& f);
};

struct ObjectConfig {
  std::string name;
  std::unique_ptr<ShapeSource> shape;
  PlaceConfig place;
  std::vector<NamedSelection> selections;
  std::vector<std::unique_ptr<Energy>> energies;
  std::vector<std::unique_ptr<Motion>> motion;
  std::vector<std::unique_ptr<Load>> loads;
  Vec3 velocity = Vec3::Zero();  // m/s
  void fields(Fields& f);
};

struct PairConfig {
  std::vector<std::string> between;
  bool contact = true;
  std::unique_ptr<BarrierLaw> barrier;
  std::unique_ptr<AdhesionLaw> adhesion;
  std::optional<FrictionConfig> friction;
  std::optional<TangentialAdhesionConfig> tangential_adhesion;
  std::string integrate = "automatic";
  void fields(Fields& f);
};

struct ContactConfig {
  enum class Weights { area, pair };
  double distance = 1e-3;  // dhat_b [m]
  double guard = 0.5;      // range of guard stencils, in contact distances
  Weights weights = Weights::area;
  std::unique_ptr<BarrierLaw> barrier = Registry<BarrierLaw>::make("clamped_log");
  std::optional<FrictionConfig> friction;
  LaggingConfig lagging;
  std::vector<PairConfig> pairs;
  void fields(Fields& f);
};

struct OutputConfig {
  double frame_interval = 0;  // s; 0: every step
  bool frames = true;
  std::optional<double> checkpoint_interval;  // s
  std::vector<std::string> frame_fields = {"velocity", "contact_force", "adhesion_force",
                                           "friction_force"};
  void fields(Fields& f);
};

struct SceneConfig {
  std::string name;
  std::string about;
  TimeConfig time;
  Vec3 gravity = Vec3::Zero();  // m/s^2
  std::vector<ObjectConfig> objects;
  std::vector<NamedSelection> selections;
  std::optional<ContactConfig> contact;
  std::unique_ptr<Minimizer> solver = Registry<Minimizer>::make("projected_newton");
  std::vector<std::unique_ptr<Probe>> probes;
  OutputConfig output;
  std::vector<Expectation> expect;
  void fields(Fields& f);
};

}  // namespace tack
