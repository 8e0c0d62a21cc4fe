#include "framework/view/run_view.hpp"

#include <algorithm>
#include <charconv>

#include "framework/output/folder_lock.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Returns 0 for anything but a number.
int number(const HttpRequest& request, const char* name) {
  int value = 0;
  if (const auto found = request.query.find(name); found != request.query.end())
    std::from_chars(found->second.data(), found->second.data() + found->second.size(), value);
  return std::max(0, value);
}

HttpAnswer json_answer(const Json& document) {
  return {200, "application/json", document.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

Json json_of(const RunControl::Progress& p) {
  return {{"start", p.start},     {"end", p.end},             {"time", p.time},         {"step", p.step},     {"iterations", p.iterations}, {"contacts", p.contacts},
          {"min_gap", p.min_gap}, {"iteration", p.iteration}, {"residual", p.residual}, {"paused", p.paused}, {"holding", p.waiting},       {"stopped", p.stopped}};
}

}  // namespace

RunView::RunView(fs::path folder, std::string version, std::string commit, RunControl* control)
    : kind_(kind_of(folder)), control_(control), news_(folder) {
  report_.folders = {std::move(folder)};
  report_.version = std::move(version);
  report_.commit = std::move(commit);
}

bool RunView::running() const { return control_ ? !control_->progress().over : FolderLock::is_locked(report_.folders[0]); }

HttpAnswer RunView::answer(const HttpRequest& request) {
  if (request.post) return order(request.path);
  if (request.path.empty()) return page();
  if (request.path == "news" && kind_ == FolderKind::run) return news(request);
  return {404, "text/plain", ""};
}

// Asks for the generation first: results written since then count as news.
HttpAnswer RunView::page() {
  const std::lock_guard lock(reading_);
  const int generation = kind_ == FolderKind::run ? news_.generation() : 0;
  PageData data = report_data(report_);
  if (kind_ == FolderKind::run) data.document["live"] = {{"generation", generation}, {"controlled", control_ != nullptr}};
  return {200, "text/html; charset=utf-8", page_with(page_path(), data, Requests::own)};
}

HttpAnswer RunView::news(const HttpRequest& request) {
  const bool is_running = running();  // before reading the last results
  const RunNews::Known known{number(request, "steps"), number(request, "probes"), number(request, "frames"), number(request, "ended") > 0};
  const std::lock_guard lock(reading_);
  Json news = news_.since(known, is_running);
  news["running"] = is_running;
  if (control_) news["progress"] = json_of(control_->progress());
  return json_answer(news);
}

HttpAnswer RunView::order(const std::string& what) {
  if (!control_) return {404, "text/plain", ""};
  if (what == "pause" || what == "resume") control_->pause(what == "pause");
  else if (what == "stop") control_->stop();
  else return {404, "text/plain", ""};
  return json_answer(json_of(control_->progress()));
}

}  // namespace tack
