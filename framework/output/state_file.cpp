#include "framework/output/state_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "framework/config/bind.hpp"
#include "framework/config/describe.hpp"
#include "framework/config/parse.hpp"
#include "framework/config/read_file.hpp"
#include "geometry/checksum.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

using Json = nlohmann::json;

constexpr std::string_view format = "tack state ";
constexpr int version = 2;
constexpr std::uintmax_t largest_state = std::uintmax_t(16) << 30;  // bytes

const char* name_of(StateFile::Kind kind) {
  return kind == StateFile::Kind::problem ? "problem" : "checkpoint";
}

Json to_json(const VecX& x) { return std::vector<double>(x.data(), x.data() + x.size()); }

VecX vector_of(const Json& json) {
  const auto numbers = json.get<std::vector<double>>();
  return Eigen::Map<const VecX>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

// first: all files have the field; later: files of earlier programs may lack it, and the default
// applies.
enum class Since { first, later };

template <class Field>
constexpr bool is_record = std::is_same_v<Field, EnergyAccount> || std::is_same_v<Field, ReferenceEnergy> || std::is_same_v<Field, GroupAccount>;

template <class Account, class Act>
  requires std::is_same_v<std::remove_const_t<Account>, GroupAccount>
void for_each_field(Account& a, const Act& act) {
  act("kinetic", a.kinetic, Since::first);
  act("gravity", a.gravity, Since::first);
  act("elastic", a.elastic, Since::first);
  act("contact", a.contact, Since::first);
  act("dissipated", a.dissipated, Since::first);
  act("moved", a.reference_energy, Since::first);
  act("met_another", a.met_another, Since::first);
}

template <class Account, class Act>
  requires std::is_same_v<std::remove_const_t<Account>, EnergyAccount>
void for_each_field(Account& a, const Act& act) {
  act("open", a.open, Since::first);
  act("kinetic", a.kinetic, Since::first);
  act("gravity", a.gravity, Since::first);
  act("elastic", a.elastic, Since::first);
  act("contact", a.contact, Since::first);
  act("gradient", a.gradient, Since::first);
  act("lowest", a.numerical_gain_low, Since::first);
  act("unexplained", a.numerical_gain, Since::first);
  act("dissipated", a.dissipated, Since::later);
  act("loads", a.loads, Since::later);
  act("moved", a.reference_energy, Since::later);
  act("bottom", a.numerical_gain_min, Since::later);
  act("grown_steps", a.growing_steps, Since::later);
  act("told", a.growth_warned, Since::later);
  act("groups", a.groups, Since::later);
}

template <class Energy, class Act>
  requires std::is_same_v<std::remove_const_t<Energy>, ReferenceEnergy>
void for_each_field(Energy& a, const Act& act) {
  act("kinetic", a.kinetic, Since::first);
  act("dissipated", a.dissipated, Since::first);
  act("elastic", a.elastic, Since::first);
  act("contact", a.contact, Since::first);
  act("gravity", a.gravity, Since::first);
  act("work", a.work, Since::first);
}

template <class S, class Act>
  requires std::is_same_v<std::remove_const_t<S>, State>
void for_each_field(S& s, const Act& act) {
  act("time", s.time, Since::first);
  act("step", s.step, Since::first);
  act("h_before", s.h_before, Since::first);
  act("acted_before", s.contact_time_before, Since::later);
  act("h_next", s.step_size.h_next, Since::first);
  act("calm_steps", s.step_size.steady_steps, Since::later);
  act("adapts", s.adapts, Since::later);
  act("error_before", s.step_size.error_before, Since::later);
  act("wary_until", s.step_size.no_growth_until, Since::later);
  act("h_cap", s.step_size.h_max, Since::later);
  act("held", s.motion_active, Since::first);
  act("x", s.x, Since::first);
  act("v", s.v, Since::first);
  act("a", s.a, Since::first);
  act("anchor", s.x_motion_start, Since::first);
  act("x_before", s.x_before, Since::first);
  act("v_before", s.v_before, Since::first);
  act("contact", s.contact, Since::later);
  act("contact_before", s.contact_before, Since::later);
  act("history", s.history, Since::later);
  act("energy", s.energy, Since::later);
}

Json to_json(const History& history) {
  Json json = Json::object();
  for (const auto& [name, array] : history)
    json[name] = {{"width", array.width}, {"values", array.values}, {"keys", array.keys}};
  return json;
}

void read_history(const Json& json, History& history) {
  history.clear();
  for (const auto& [name, array] : json.items()) {
    HistoryArray& read = history[name];
    array.at("width").get_to(read.width);
    array.at("values").get_to(read.values);
    array.at("keys").get_to(read.keys);
    if (read.width < 1 || read.values.size() % read.width != 0)
      throw InputError(fmt::format("its history '{}' has no valid shape", name));
  }
}

template <class Record>
Json fields_to_json(const Record& record) {
  Json json = Json::object();
  for_each_field(record, [&]<class Field>(const char* key, const Field& field, Since) {
    if constexpr (is_record<Field>) {
      json[key] = fields_to_json(field);
    } else if constexpr (std::is_same_v<Field, VecX> || std::is_same_v<Field, History>) {
      json[key] = to_json(field);
    } else if constexpr (std::is_same_v<Field, std::vector<GroupAccount>>) {
      json[key] = Json::array();
      for (const GroupAccount& group : field) json[key].push_back(fields_to_json(group));
    } else {
      json[key] = field;
    }
  });
  return json;
}

template <class Field>
void read(const Json& json, const char* key, Field& field);

template <class Record>
void read_fields(const Json& json, Record& record) {
  for_each_field(record, [&](const char* key, auto& field, Since since) {
    if (since == Since::first || json.contains(key)) read(json, key, field);
  });
}

template <class Field>
void read(const Json& json, const char* key, Field& field) {
  if constexpr (std::is_same_v<Field, VecX>) {
    field = vector_of(json.at(key));
  } else if constexpr (is_record<Field>) {
    read_fields(json.at(key), field);
    if constexpr (std::is_same_v<Field, EnergyAccount>)
      for (const char* name : {"friction", "plastic", "damping"})  // in files of earlier programs
        if (json.at(key).contains(name)) field.dissipated.emplace_back(std::string("dissipated_") + name, json.at(key).at(name).template get<double>());
  } else if constexpr (std::is_same_v<Field, History>) {
    read_history(json.at(key), field);
  } else if constexpr (std::is_same_v<Field, std::vector<GroupAccount>>) {
    field.resize(json.at(key).size());
    for (size_t i = 0; i < field.size(); ++i) read_fields(json.at(key)[i], field[i]);
  } else {
    json.at(key).get_to(field);
  }
}

Json to_json(const std::vector<WarningCount>& warnings) {
  Json json = Json::array();
  for (const WarningCount& w : warnings) json.push_back({w.first.text, entry_of(w.first.kind).key, w.times, w.first.subject});
  return json;
}

std::vector<WarningCount> warnings_of(const Json& json) {
  std::vector<WarningCount> warnings;
  for (const Json& w : json) {
    const WarningKind kind = warning_kind_of(w.at(1).get<std::string>()).value_or(WarningKind::unspecified);
    warnings.push_back({{kind, w.at(0).get<std::string>(), w.size() > 3 ? w[3].get<std::string>() : ""}, w.at(2).get<int>()});
  }
  return warnings;
}

Json to_json(const Mesh& mesh) {
  Json vertices = Json::array();
  for (const Vec3& v : mesh.vertices) vertices.push_back({v.x(), v.y(), v.z()});
  return {{"vertices", vertices}, {"tets", mesh.tets},     {"triangles", mesh.triangles},
          {"edges", mesh.edges},  {"points", mesh.points}, {"tags", mesh.tags}};
}

Mesh mesh_of(const Json& json) {
  Mesh mesh;
  for (const Json& v : json.at("vertices")) mesh.vertices.emplace_back(v.at(0), v.at(1), v.at(2));
  read(json, "tets", mesh.tets);
  read(json, "triangles", mesh.triangles);
  read(json, "edges", mesh.edges);
  read(json, "points", mesh.points);
  read(json, "tags", mesh.tags);
  return mesh;
}

Json to_json(const FlowedMesh& flowed) {
  Json json = to_json(flowed.mesh);
  json["surface"] = flowed.surface;
  std::vector<double> shapes, volumes;
  for (const TetReference& r : flowed.references) {
    shapes.insert(shapes.end(), r.shape.data(), r.shape.data() + 9);
    volumes.push_back(r.volume);
  }
  json["shapes"] = shapes;
  json["volumes"] = volumes;
  return json;
}

FlowedMesh flowed_of(const Json& json) {
  FlowedMesh flowed{mesh_of(json), {}, {}};
  read(json, "surface", flowed.surface);
  const auto shapes = json.at("shapes").get<std::vector<double>>(), volumes = json.at("volumes").get<std::vector<double>>();
  const size_t n = flowed.mesh.tets.size();
  const int vertices = static_cast<int>(flowed.mesh.vertices.size());
  const auto fits = [&](const auto& elements) {
    return std::all_of(elements.begin(), elements.end(), [&](const auto& e) {
      return std::all_of(e.begin(), e.end(), [&](int v) { return v >= 0 && v < vertices; });
    });
  };
  if (volumes.size() != n || shapes.size() != 9 * n || !fits(flowed.mesh.tets) || !fits(flowed.surface)) throw InputError("the mesh of a remeshed object is invalid");
  for (size_t t = 0; t < n; ++t) flowed.references.push_back({Eigen::Map<const Mat3>(&shapes[9 * t]), volumes[t]});
  return flowed;
}

Json to_json(const std::vector<Remeshing>& all) {
  Json json = Json::array();
  for (const Remeshing& r : all) json.push_back({r.object, r.step, r.time, r.before, r.after, r.tets_before, r.tets_after, r.lost});
  return json;
}

std::vector<Remeshing> remeshings_of(const Json& json) {
  std::vector<Remeshing> all;
  for (const Json& r : json) all.push_back({r.at(0), r.at(1), r.at(2), r.at(3), r.at(4), r.at(5), r.at(6), r.at(7)});
  return all;
}

Json to_json(const MeshDigest& d) {
  return {d.vertex_count, d.element_count, d.vertices, d.elements, d.groups};
}

MeshDigest digest_of(const Json& json) { return {json.at(0), json.at(1), json.at(2), json.at(3), json.at(4)}; }

[[noreturn]] void refuse_file(const std::filesystem::path& path, const std::string& why) {
  throw InputError(fmt::format("{}: {}", path.string(), why));
}

std::string head_of(int number, std::uint32_t checksum, std::size_t size) {
  return fmt::format("{}{} crc32 {:08x} bytes {}\n", format, number, checksum, size);
}

// Returns the map of a file. The checksum is verified before parsing, so that the parser never
// reads damaged data.
Json content_of(const std::filesystem::path& path) {
  const std::string text = read_file(path, largest_state);
  const auto line_end = text.find('\n');
  int number = 0;
  if (text.starts_with(format)) std::from_chars(text.data() + format.size(), text.data() + text.size(), number);
  // Version 1 was a map without header line, with the format's name inside.
  else if (text.find("tack state") != text.npos && text.find("whole_steps") != text.npos) number = 1;
  if (number == 0) refuse_file(path, "is not a complete file of `tack run --dump-problem` or output.checkpoint_interval; "
                               "write it again");
  if (number != version)
    refuse_file(path, fmt::format("has version {} of the format, and this program reads version {}; write it again",
                                  number, version));
  const std::string_view content = std::string_view(text).substr(line_end + 1);
  if (line_end == text.npos ||
      text.substr(0, line_end + 1) != head_of(version, crc32_of(content.data(), content.size()), content.size()))
    refuse_file(path, "is damaged or cut short (its checksum is not that of its content); write it again");
  return Json::from_cbor(content);
}

constexpr std::size_t head_size_max = 128;  // bytes

// Returns an upper bound of the size of a value in CBOR [bytes].
std::size_t cbor_size_max(const Json& json) {
  constexpr std::size_t per_item = 9;  // type and a number
  std::size_t size = per_item;
  if (json.is_string()) size += json.get_ref<const std::string&>().size();
  if (json.is_object())
    for (const auto& [key, value] : json.items()) size += per_item + key.size() + cbor_size_max(value);
  if (json.is_array())
    for (const Json& value : json) size += cbor_size_max(value);
  return size;
}

std::string cbor_of(const StateFile& file) {
  Json meshes = Json::object(), file_meshes = Json::object(), objects = Json::object();
  for (const auto& [object, mesh] : file.meshes) meshes[object] = to_json(mesh);
  for (const auto& [object, digest] : file.file_meshes) file_meshes[object] = to_json(digest);
  for (const auto& [name, object] : file.objects) objects[name] = {{"vertices", object.vertices}, {"mesh", to_json(object.mesh)}};
  Json json = {{"kind", name_of(file.kind)}, {"program", file.program}, {"commit", file.commit},
                     {"scene", file.scene}, {"meshes", meshes}, {"file_meshes", file_meshes}, {"plugins", file.plugins}, {"files", file.files}, {"objects", objects},
                     {"state", fields_to_json(file.state)}, {"step_size", file.step_size}, {"totals", file.totals},
                     {"warnings", to_json(file.warnings)}};
  for (const auto& [object, flowed] : file.flowed) json["flowed"][object] = to_json(flowed);
  if (file.minimum.size() > 0) json["minimum"] = to_json(file.minimum), json["minimum_tolerance"] = file.minimum_tolerance;
  if (!file.linear_solver.empty()) json["linear_solver"] = file.linear_solver;
  if (!file.remeshings.empty()) json["remeshings"] = to_json(file.remeshings);
  std::string content;
  content.reserve(head_size_max + cbor_size_max(json));  // growing would take up to three times the memory
  Json::to_cbor(json, content);
  return content;
}

}  // namespace

void write_state_file(const std::filesystem::path& path, const StateFile& file) {
  std::string content = cbor_of(file);
  replace_file(path, content.insert(0, head_of(version, crc32_of(content.data(), content.size()), content.size())));
}

StateFile read_state_file(const std::filesystem::path& path, StateFile::Kind kind) {
  StateFile file;
  file.kind = kind;
  try {
    const Json json = content_of(path);
    if (const std::string found = json.at("kind"); found != name_of(kind))
      refuse_file(path, fmt::format("is a {}, and a {} is needed", found, name_of(kind)));
    read(json, "program", file.program);
    read(json, "commit", file.commit);
    read(json, "scene", file.scene);
    for (const auto& [object, mesh] : json.at("meshes").items()) file.meshes[object] = mesh_of(mesh);
    if (json.contains("file_meshes"))
      for (const auto& [object, digest] : json["file_meshes"].items()) file.file_meshes[object] = digest_of(digest);
    if (json.contains("plugins")) json["plugins"].get_to(file.plugins);
    if (json.contains("files")) json["files"].get_to(file.files);
    if (json.contains("objects"))
      for (const auto& [name, object] : json["objects"].items())
        file.objects[name] = {object.at("vertices").get<std::vector<int>>(), digest_of(object.at("mesh"))};
    read_fields(json.at("state"), file.state);
    // Files of version 2 initially had contact sides outside of the history.
    if (const auto sides = json.at("state").find("sides"); sides != json.at("state").end() && !sides->empty())
      file.state.history["contact/sides"] = {1, sides->get<std::vector<double>>(), {}};
    read(json, "step_size", file.step_size);
    read(json, "totals", file.totals);
    if (json.contains("minimum")) read(json, "minimum", file.minimum), read(json, "minimum_tolerance", file.minimum_tolerance);
    if (json.contains("linear_solver")) read(json, "linear_solver", file.linear_solver);
    if (json.contains("warnings")) file.warnings = warnings_of(json["warnings"]);
    if (json.contains("flowed"))
      for (const auto& [object, flowed] : json["flowed"].items()) file.flowed[object] = flowed_of(flowed);
    if (json.contains("remeshings")) file.remeshings = remeshings_of(json["remeshings"]);
  } catch (const Json::exception& error) {
    refuse_file(path, fmt::format("is damaged ({}); write it again", error.what()));
  }
  return file;
}

bool begins_as_state_file(const std::filesystem::path& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return false;  // reading a pipe may wait for ever
  std::ifstream in(path, std::ios::binary);
  std::string head(format.size(), '\0');
  return in.read(head.data(), static_cast<std::streamsize>(head.size())) && head == format;
}

void check_size(const StateFile& file, Eigen::Index vertices, const std::string& name) {
  const State& s = file.state;
  for (const VecX* field : {&s.x, &s.v, &s.a})
    if (field->size() != 3 * vertices)
      refuse_file(name, fmt::format("its state has {} coordinates, but its scene {} vertices; write it again",
                               field->size(), vertices));
  if (file.minimum.size() != 0 && file.minimum.size() != 3 * vertices) refuse_file(name, "its minimum does not fit its scene; write it again");
  for (const VecX* field : {&s.x_motion_start, &s.x_before, &s.v_before, &s.contact, &s.contact_before, &s.energy.gradient})
    if (field->size() != 0 && field->size() != 3 * vertices)
      refuse_file(name, "its state does not fit its scene; write it again");
}

}  // namespace tack
