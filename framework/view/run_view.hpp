// Serves a results folder as a page. The page of a run fetches new results while it is open, and
// can pause and stop a run of this program.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>

#include "framework/report/report.hpp"
#include "framework/run/run_control.hpp"
#include "framework/view/http_server.hpp"
#include "framework/view/run_news.hpp"

namespace tack {

class RunView {
 public:
  // version, commit: of the program. control: of the run that writes into the folder; null if it is
  // not this program's.
  RunView(std::filesystem::path folder, std::string version, std::string commit,
          RunControl* control = nullptr);

  // Answers a request:
  //    GET ""                                      the page; data of a run contain `live`
  //                                                {generation, controlled}
  //    GET "news?steps=&probes=&frames=&ended="    RunNews::since, with running and progress
  //                                                {start, end, time, step, iterations, contacts,
  //                                                min_gap, iteration, residual, paused, holding,
  //                                                stopped}
  //    POST "pause", "resume", "stop"
  HttpAnswer answer(const HttpRequest& request);

 private:
  HttpAnswer page();
  HttpAnswer news(const HttpRequest& request);
  HttpAnswer order(const std::string& what);
  bool running() const;

  ReportSettings report_;
  FolderKind kind_;
  RunControl* control_;
  std::mutex reading_;
  RunNews news_;
};

}  // namespace tack
