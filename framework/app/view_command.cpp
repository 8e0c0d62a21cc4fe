// tack view: serves pages about a scene, a run or results to a browser on this machine.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <optional>
#include <thread>

#include "framework/app/commands.hpp"
#include "framework/app/interrupt_signals.hpp"
#include "framework/app/memory_limit.hpp"
#include "framework/app/thread_limit.hpp"
#include "framework/output/provenance.hpp"
#include "framework/run/run_control.hpp"
#include "framework/view/preview.hpp"
#include "framework/view/run_view.hpp"
#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"
#include "geometry/io/replace_file.hpp"
#include "geometry/run_program.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds signal_interval{50};

bool has_display() {
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return value && *value;
  };
  return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

// A file that only this user can read and that redirects a browser to an address: the address
// contains the token, and every user of the machine can read the command line of the browser.
// Removed by the destructor.
class RedirectPage {
 public:
  explicit RedirectPage(const std::string& address) : path_((fs::temp_directory_path() / "tack_view_XXXXXX.html").string()) {
    const int file = ::mkstemps(path_.data(), 5);  // mode 0600
    const std::string page = fmt::format("<!doctype html><meta http-equiv=\"refresh\" content=\"0; url={0}\"><a href=\"{0}\">tack</a>\n", address);
    if (file < 0) path_.clear();
    else if (::write(file, page.data(), page.size()) != static_cast<ssize_t>(page.size())) remove();
    if (file >= 0) ::close(file);
  }
  ~RedirectPage() { remove(); }
  RedirectPage(const RedirectPage&) = delete;
  RedirectPage& operator=(const RedirectPage&) = delete;
  const std::string& path() const { return path_; }  // "" if the file could not be written

 private:
  void remove() {
    if (!path_.empty()) ::unlink(path_.c_str());
    path_.clear();
  }
  std::string path_;
};

// The address is always printed, for a browser on another machine that connects through a tunnel.
void announce(const std::string& address, const ViewOptions& options) {
  fmt::print("{}\n", address);
  std::fflush(stdout);
  if (options.no_browser || !has_display()) return;
  static const RedirectPage page(address);
  if (!page.path().empty()) std::thread([] { run_program({"xdg-open", page.path()}, {{}, "/dev/null", true}); }).detach();
}

void wait_for_interrupt() {
  while (!interrupt_requested) std::this_thread::sleep_for(signal_interval);
}

// Makes an empty page, so that a missing page file is an error before the run.
void need_page() { page_with(page_path(), PageData(), Requests::own); }

PageData preview_of(const ViewOptions& options) {
  return preview_data({options.scene.file, overrides_with_plugins(options.scene), this_build().version, this_build().revision()});
}

int write_preview(const ViewOptions& options) {
  replace_file(options.output, page_with(page_path(), preview_of(options)));
  fmt::print("{}\n", options.output);
  return exit_done;
}

// The scene is read again at each load of the page.
int serve_preview(const ViewOptions& options) {
  need_page();
  std::mutex making;
  std::optional<std::string> ready = page_with(page_path(), preview_of(options));
  const HttpServer server([&](const HttpRequest& request) -> HttpAnswer {
    if (request.post || !request.path.empty()) return {404, "text/plain", ""};
    const std::lock_guard lock(making);
    HttpAnswer answer{200, "text/html; charset=utf-8", ready ? std::move(*ready) : page_with(page_path(), preview_of(options))};
    ready.reset();
    return answer;
  });
  announce(server.address(), options);
  wait_for_interrupt();
  return exit_done;
}

int show_results(const ViewOptions& options) {
  if (!options.scene.overrides.empty() || !options.scene.plugins.empty())
    throw InputError(fmt::format("{}: is a folder of results, and {} is for a scene; leave it out", options.scene.file, options.scene.overrides.empty() ? "--plugin" : "--set"));
  if (!options.output.empty()) {
    ReportSettings report;
    report.folders = {options.scene.file};
    report.output = options.output;
    report.version = this_build().version;
    report.commit = this_build().revision();
    fmt::print("{}\n", write_report(report).path.string());
    return exit_done;
  }
  need_page();
  RunView view(options.scene.file, this_build().version, this_build().revision());
  const HttpServer server([&](const HttpRequest& request) { return view.answer(request); });
  announce(server.address(), options);
  wait_for_interrupt();
  return exit_done;
}

int run_and_show(const ViewOptions& options) {
  if (fs::path(options.output).extension() == ".html") throw InputError(fmt::format("{}: with --run, -o is the folder of the results; leave --run out for a page of the scene", options.output));
  need_page();
  const ThreadLimit threads(options.threads);
  check_address_space(threads.count());
  RunControl control;
  RunSettings settings = options;
  settings.control = &control;
  RecordedRun run(loaded_scene(options.scene), settings, provenance_of(options.command_line, threads.count()), std::cout,
                  progress_options(options));
  RunView view(run.folder(), this_build().version, this_build().revision(), &control);
  const HttpServer server([&](const HttpRequest& request) { return view.answer(request); });
  announce(server.address(), options);
  const int code = exit_code(run.execute().status);
  control.end();
  // A stop from the page ends the run, but not the server.
  if (control.progress().stopped) interrupt_requested = false;
  if (!interrupt_requested) fmt::print("served until Ctrl-C: {}\n", server.address());
  std::fflush(stdout);
  wait_for_interrupt();
  return code;
}

}  // namespace

int view_command(const ViewOptions& options) {
  let_signals_interrupt();
  if (options.run) return run_and_show(options);
  if (fs::is_directory(options.scene.file)) return show_results(options);
  return options.output.empty() ? serve_preview(options) : write_preview(options);
}

}  // namespace tack
