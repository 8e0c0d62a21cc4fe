// Points that searches on threads of their own wait for, and that the main thread has run: only that may start processes.
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
    Point values;
    bool derivatives = false;  // are wanted too
    std::optional<PointEvaluation> answer;
  };

  // `searches` threads will ask.
  explicit PointQueue(int searches = 0) : searching_(searches) {}

  // Of a search: waits for the answer; nothing if all was cancelled.
  std::optional<PointEvaluation> ask(const Point& values);
  void end_search();

  // Of the main thread. Asks itself, and does not wait; the request stays as long as the queue.
  Request& add(const Point& values, bool derivatives = false);
  // What was asked since, in the order in which it was. A request stays where it is until it is answered.
  std::vector<Request*> take();
  void answer(Request& request, PointEvaluation evaluation);
  void cancel();
  void wait_for_all();  // until every search that goes on waits for an answer, or none goes on
  bool over() const;    // no search goes on, and everything is answered

 private:
  std::list<Request>::iterator put(const Point& values, bool derivatives);

  mutable std::mutex mutex_;
  std::condition_variable answered_, asked_;
  std::list<Request> requests_;
  std::vector<Request*> fresh_;
  int searching_, waiting_ = 0;  // threads that may ask; requests that are not answered
  bool cancelled_ = false;
};

// What gives points their evaluations. `serve` answers all requests, from the main thread, until the queue is over; it ends early, with
// everything cancelled, if an interrupt is requested.
class Evaluator {
 public:
  virtual ~Evaluator() = default;
  virtual void serve(PointQueue& queue) = 0;
  // For each number why runs give no derivatives by it, "" if they do; nothing if they give none at all.
  virtual std::vector<std::string> without_derivatives() { return {}; }

  // Evaluations in the order of the points, with derivatives by numbers that have them if they are wanted. Throws Interrupted.
  std::vector<PointEvaluation> at(const std::vector<Point>& points, bool derivatives = false);
  // Runs all searches side by side, each on a thread. Throws Interrupted.
  using Ask = std::function<std::optional<PointEvaluation>(const Point&)>;
  void search(const std::vector<std::function<void(const Ask&)>>& searches);
};

}  // namespace tack
