#include "framework/plugin/shared_library.hpp"

#include <elf.h>
#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "geometry/errors.hpp"

namespace tack {
namespace {

class LibraryFile {
 public:
  explicit LibraryFile(const std::string& path) : path_(path) {
    std::ifstream in(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
    if (!in) throw InputError(fmt::format("cannot read '{}'", path));
    if (bytes_.size() < sizeof header_ || std::memcmp(bytes_.data(), ELFMAG, SELFMAG) != 0) refuse();
    header_ = at<Elf64_Ehdr>(0);
    if (header_.e_ident[EI_CLASS] != ELFCLASS64 || header_.e_type != ET_DYN) refuse();
  }

  std::optional<std::string> section(const std::string& name) const {
    if (header_.e_shnum == 0) return std::nullopt;
    const Elf64_Shdr names = table_entry(header_.e_shstrndx);
    for (int i = 0; i < header_.e_shnum; ++i) {
      const Elf64_Shdr entry = table_entry(i);
      const std::string found = text(names.sh_offset + entry.sh_name, name.size() + 1);
      if (found == name + '\0') return text(entry.sh_offset, entry.sh_size);
    }
    return std::nullopt;
  }

 private:
  [[noreturn]] void refuse() const { throw InputError(fmt::format("'{}' is no shared library, or a damaged one", path_)); }

  std::string text(std::uint64_t offset, std::uint64_t size) const {
    if (offset > bytes_.size()) refuse();
    return bytes_.substr(offset, size);
  }
  template <class T>
  T at(std::uint64_t offset) const {
    T out;
    if (bytes_.size() < sizeof out || offset > bytes_.size() - sizeof out) refuse();
    std::memcpy(&out, bytes_.data() + offset, sizeof out);
    return out;
  }
  Elf64_Shdr table_entry(std::uint64_t i) const { return at<Elf64_Shdr>(header_.e_shoff + i * sizeof(Elf64_Shdr)); }

  std::string path_, bytes_;
  Elf64_Ehdr header_{};
};

}  // namespace

std::optional<std::string> library_section(const std::string& path, const std::string& section) {
  return LibraryFile(path).section(section);
}

}  // namespace tack
