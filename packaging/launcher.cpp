// tack as packages install it: the program is there once for each instruction set, in libexec/tack/ARCHITECTURE/bin, and this starts the best that the processor
// has, or the one that the environment variable TACK_ARCHITECTURE names: results of one are the same bits on every machine.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

namespace {

namespace fs = std::filesystem;

struct Architecture {
  const char* name;
  bool here;  // the processor has it
};

int failed(const std::string& why) {
  std::fprintf(stderr, "error: %s\n", why.c_str());
  return 2;
}

}  // namespace

int main(int, char** argv) {
  __builtin_cpu_init();
  const Architecture all[] = {{"x86-64-v4", __builtin_cpu_supports("x86-64-v4") != 0}, {"x86-64-v3", __builtin_cpu_supports("x86-64-v3") != 0}, {"x86-64", true}};
  std::error_code none;
  const fs::path folder = fs::read_symlink("/proc/self/exe", none).parent_path().parent_path() / "libexec" / "tack";
  const char* asked = std::getenv("TACK_ARCHITECTURE");
  std::string installed;
  for (const Architecture& a : all) {
    const fs::path program = folder / a.name / "bin" / "tack";
    if (!fs::exists(program, none)) continue;
    installed += std::string(installed.empty() ? "" : ", ") + a.name;
    if (asked && *asked ? std::strcmp(asked, a.name) != 0 : !a.here) continue;
    if (!a.here) return failed(std::string("TACK_ARCHITECTURE: this processor is no ") + a.name + "; leave it out");
    ::execv(program.c_str(), argv);
    return failed(program.string() + " cannot be started: " + std::strerror(errno));
  }
  if (asked && *asked) return failed(std::string("TACK_ARCHITECTURE: there is no '") + asked + "'; installed are: " + installed);
  return failed("there is no program in " + folder.string() + "; install tack again");
}
