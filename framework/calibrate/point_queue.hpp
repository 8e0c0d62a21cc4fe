// A queue of points between search threads, which wait for evaluations, and the main thread, which
// alone may start processes.
#pragma once

#include <condition_variable>
#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <vector>

#include "framework/calibrate/point_evaluation.hpp"

namespace tack {

class PointQueue {
 public:
  struct Request {
    DesignPoint values;
    bool derivatives = false;  // requested too
    std::optional<PointEvaluation> answer;
  };

  // searches: number of threads that will call ask().
  explicit PointQueue(int searches = 0) : searching_(searches) {}

  // Called by a search thread: waits for the evaluation; returns nothing if all was cancelled.
  std::optional<PointEvaluation> ask(const DesignPoint& values);
  void end_search();

  // Called by the main thread: adds a request without waiting. The request lives as long as the
  // queue.
  Request& add(const DesignPoint& values, bool derivatives = false);
  // Returns the new requests in their order. A request keeps its address until it is answered.
  std::vector<Request*> take();
  void answer(Request& request, PointEvaluation evaluation);
  void cancel();
  // Waits until every active search waits for an answer, or no search is active.
  void wait_for_all();
  bool finished() const;  // no search is active, and all requests are answered

 private:
  std::list<Request>::iterator put(const DesignPoint& values, bool derivatives);

  mutable std::mutex mutex_;
  std::condition_variable answered_, asked_;
  std::list<Request> requests_;
  std::vector<Request*> new_requests_;
  int searching_, waiting_ = 0;  // active searches; unanswered requests
  bool cancelled_ = false;
};

// Evaluates points. `serve`, called by the main thread, answers all requests until the queue is
// over; it cancels everything and returns early if an interrupt is requested.
class Evaluator {
 public:
  virtual ~Evaluator() = default;
  virtual void serve(PointQueue& queue) = 0;
  // Returns, per parameter, the reason why runs give no sensitivities to it, "" if they do; empty
  // if runs give none at all.
  virtual std::vector<std::string> without_derivatives() { return {}; }

  // Evaluates points and returns the results in their order. With `derivatives`, for all parameters
  // that support them. Throws Interrupted.
  std::vector<PointEvaluation> at(const std::vector<DesignPoint>& points, bool derivatives = false);
  // Runs all searches at the same time, each on its own thread. Throws Interrupted.
  using Ask = std::function<std::optional<PointEvaluation>(const DesignPoint&)>;
  void search(const std::vector<std::function<void(const Ask&)>>& searches);
};

}  // namespace tack
