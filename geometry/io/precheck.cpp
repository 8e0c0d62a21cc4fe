#include "geometry/io/precheck.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unordered_set>

#include "geometry/errors.hpp"

namespace tack {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw InputError(fmt::format("{}: {}: export it again", name, what));
}

std::ifstream open(const std::string& name) { return std::ifstream(name, std::ios::binary); }

// Reads a list of `count` cells "k i1 ... ik"; returns true if it has `size` numbers in total.
bool has_cells(std::istream& file, long count, long size) {
  long read = 0, corners = 0, index = 0;
  for (long cell = 0; cell < count; ++cell) {
    if (!(file >> corners) || corners < 0 || corners > size) return false;
    for (long i = 0; i < corners; ++i) {
      if (!(file >> index)) return false;
    }
    read += corners + 1;
  }
  return read == size;
}

// Returns true if at least `count` numbers of four bytes follow.
bool has_numbers(std::istream& file, long count) {
  const auto here = file.tellg();
  file.seekg(0, std::ios::end);
  const bool enough = count >= 0 && count < (file.tellg() - here) / 4 + 1;
  file.seekg(here);
  return enough;
}

bool is_cell_list(const std::string& word) {
  return word == "CELLS" || word == "POLYGONS" || word == "LINES" || word == "VERTICES" ||
         word == "TRIANGLE_STRIPS";
}

std::unordered_set<long> msh_nodes(std::istream& file) {
  std::unordered_set<long> nodes;
  long count = 0, tag = 0;
  file >> count;
  for (std::string rest; count > 0 && file >> tag && std::getline(file, rest); --count) {
    nodes.insert(tag);
  }
  return nodes;
}

void check_msh_elements(std::istream& file, const std::string& name,
                        const std::unordered_set<long>& nodes) {
  std::string line;
  std::getline(file, line);
  std::getline(file, line);  // the count
  while (std::getline(file, line) && line[0] != '$') {
    std::istringstream words(line);
    long element = 0, type = 0, tags = 0, word = 0;
    words >> element >> type >> tags;
    for (; tags > 0 && words >> word; --tags) {}
    while (words >> word) {
      if (nodes.contains(word)) continue;
      refuse(name, fmt::format("element {} uses node {}, which is not defined", element, word));
    }
  }
}

void check_msh2_ascii(std::istream& file, const std::string& name) {
  std::unordered_set<long> nodes;
  for (std::string word; file >> word;) {
    if (word == "$Nodes") nodes = msh_nodes(file);
    if (word == "$Elements") check_msh_elements(file, name, nodes);
  }
}

}  // namespace

void precheck_ply(const std::string& name) {
  std::ifstream file = open(name);
  bool in_element = false;
  for (std::string line, word; std::getline(file, line) && !line.starts_with("end_header");) {
    std::istringstream words(line);
    if (!(words >> word)) continue;
    if (word == "element") {
      long count = -1;
      in_element = (words >> word >> count) && count >= 0;
      if (!in_element) refuse(name, "an element of the header has no name or no count");
    } else if (word == "property" && !in_element) {
      refuse(name, "a property of the header belongs to no element");
    }
  }
}

void precheck_stl(const std::string& name) {
  std::ifstream file = open(name);
  char start[512] = {};
  file.read(start, sizeof start - 1);
  // Binary headers may begin with "solid" too, but do not contain "facet".
  if (std::strncmp(start, "solid", 5) == 0 && std::strstr(start, "facet")) return;
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, start + 80, sizeof triangles);
  const std::uintmax_t expected = 84 + 50 * std::uintmax_t(triangles);
  const std::uintmax_t actual = std::filesystem::file_size(name);
  if (actual < expected || triangles == 0) {
    refuse(name, fmt::format("{} bytes, but a binary .stl file of {} triangles has {}", actual,
                             triangles, expected));
  }
}

void precheck_vtk(const std::string& name) {
  std::ifstream file = open(name);
  std::string line;
  double version = 0;
  std::getline(file, line);
  if (!line.starts_with("# vtk DataFile Version")) refuse(name, "not a legacy .vtk file");
  std::istringstream(line.substr(22)) >> version;
  if (!(version >= 1 && version < 6)) refuse(name, fmt::format("version {} of the .vtk format is not known", version));
  if (version >= 5) return;
  std::getline(file, line);  // the title
  std::string word;
  file >> word;
  const bool is_ascii = word == "ASCII";
  while (file >> word) {
    if (word == "POINT_DATA" || word == "CELL_DATA") return;
    if (!is_cell_list(word)) continue;
    long count = 0, size = 0;
    if (!(file >> count >> size)) {
      if (!is_ascii) return;  // the word stood among binary numbers
      refuse(name, word + " has no count");
    }
    if (is_ascii ? has_cells(file, count, size) : has_numbers(file, size)) continue;
    refuse(name, fmt::format("{} does not hold the {} numbers that it announces", word, size));
  }
}

void precheck_msh(const std::string& name) {
  std::ifstream file = open(name);
  std::string line;
  while (std::getline(file, line) && line.starts_with("$Comments")) {
    while (std::getline(file, line) && !line.starts_with("$EndComments")) {}
  }
  double version = 0;
  int binary = 0;
  const bool is_msh = line.starts_with("$MeshFormat") && file >> version >> binary;
  if (!is_msh || (version != 2.2 && version != 4.1)) {
    refuse(name, fmt::format("not a Gmsh mesh of version 2.2 or 4.1{}",
                             is_msh ? fmt::format(" (but {})", version) : ""));
  }
  if (version == 2.2 && binary == 0) check_msh2_ascii(file, name);
}

}  // namespace tack
