#include "framework/calibrate/point_queue.hpp"

#include <exception>
#include <thread>
#include <utility>

#include "geometry/interrupt.hpp"

namespace tack {

std::list<PointQueue::Request>::iterator PointQueue::put(const DesignPoint& values, bool derivatives) {
  requests_.push_back({values, derivatives, {}});
  new_requests_.push_back(&requests_.back());
  ++waiting_;
  asked_.notify_all();
  return std::prev(requests_.end());
}

PointQueue::Request& PointQueue::add(const DesignPoint& values, bool derivatives) {
  const std::lock_guard lock(mutex_);
  return *put(values, derivatives);
}

std::optional<PointEvaluation> PointQueue::ask(const DesignPoint& values) {
  std::unique_lock lock(mutex_);
  if (cancelled_) return std::nullopt;
  const auto mine = put(values, false);
  answered_.wait(lock, [&] { return mine->answer || cancelled_; });
  std::optional<PointEvaluation> answer = std::move(mine->answer);
  requests_.erase(mine);
  return answer;
}

void PointQueue::end_search() {
  const std::lock_guard lock(mutex_);
  --searching_;
  asked_.notify_all();
}

std::vector<PointQueue::Request*> PointQueue::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(new_requests_, {});
}

void PointQueue::answer(Request& request, PointEvaluation evaluation) {
  const std::lock_guard lock(mutex_);
  request.answer = std::move(evaluation);
  --waiting_;
  answered_.notify_all();
}

void PointQueue::cancel() {
  const std::lock_guard lock(mutex_);
  cancelled_ = true;
  answered_.notify_all();
}

void PointQueue::wait_for_all() {
  std::unique_lock lock(mutex_);
  asked_.wait(lock, [&] { return waiting_ >= searching_; });
}

bool PointQueue::finished() const {
  const std::lock_guard lock(mutex_);
  return searching_ == 0 && waiting_ == 0;
}

std::vector<PointEvaluation> Evaluator::at(const std::vector<DesignPoint>& points, bool derivatives) {
  PointQueue queue;
  std::vector<PointQueue::Request*> requests;
  for (const DesignPoint& p : points) requests.push_back(&queue.add(p, derivatives));
  serve(queue);
  if (interrupt_requested) throw Interrupted{};
  std::vector<PointEvaluation> found;
  for (PointQueue::Request* r : requests) found.push_back(std::move(r->answer.value()));
  return found;
}

void Evaluator::search(const std::vector<std::function<void(const Ask&)>>& searches) {
  PointQueue queue(static_cast<int>(searches.size()));
  std::vector<std::thread> threads;
  std::vector<std::exception_ptr> failures(searches.size());
  const auto join = [&] {
    for (std::thread& t : threads) t.join();
  };
  for (size_t i = 0; i < searches.size(); ++i)
    threads.emplace_back([&, i] {
      try {
        searches[i]([&](const DesignPoint& values) { return queue.ask(values); });
      } catch (...) {
        failures[i] = std::current_exception();
      }
      queue.end_search();
    });
  try {
    serve(queue);
  } catch (...) {
    queue.cancel();
    join();
    throw;
  }
  if (interrupt_requested) queue.cancel();
  join();
  if (interrupt_requested) throw Interrupted{};
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace tack
