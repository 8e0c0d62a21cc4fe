#include "framework/rod/rod_frames.hpp"

#include <algorithm>
#include <cmath>

namespace tack {
namespace {

Edge ascending(const Edge& e) { return {std::min(e[0], e[1]), std::max(e[0], e[1])}; }

}  // namespace

RodFrames::RodFrames(std::string name, std::vector<Edge> edges, std::vector<int> twists, const std::vector<Vec3>& directors,
                     double radius, const VecX& rest)
    : history_(std::move(name)), edges_(std::move(edges)), twists_(std::move(twists)), radius_(radius), start_(rest) {
  for (int e = 0; e < count(); ++e) {
    by_vertices_.emplace_back(ascending(edges_[e]), e);
    Mat3 frame;
    frame.col(0) = tangent(e, rest);
    frame.col(1) = (directors[e] - directors[e].dot(frame.col(0)) * frame.col(0)).normalized();
    frame.col(2) = frame.col(0).cross(frame.col(1));
    at_rest_.emplace_back(frame);
  }
  std::sort(by_vertices_.begin(), by_vertices_.end());
  committed_ = at_rest_;
}

int RodFrames::find(const Edge& edge) const {
  const auto at = std::lower_bound(by_vertices_.begin(), by_vertices_.end(), std::pair{ascending(edge), 0});
  return at != by_vertices_.end() && at->first == ascending(edge) ? at->second : -1;
}

// In the committed frame, the rotation from x to the direction of l is that of the quaternion
// 1 + l_x, (0, -l_z, l_y).
Quaternion RodFrames::reference(int e, const VecX& x) const {
  const Vec3 l = committed_[e].conjugate() * tangent(e, x);
  return (committed_[e] * Quaternion(1 + l.x(), 0, -l.z(), l.y())).normalized();
}

Vec3 RodFrames::director(int e, const VecX& x) const {
  const double theta = angle(e, x);
  return reference(e, x) * Vec3(0, std::cos(theta), std::sin(theta));
}

double RodFrames::angle_to(int e, const VecX& x, const Vec3& vector) const {
  const Vec3 l = reference(e, x).conjugate() * vector;
  return std::atan2(l.z(), l.y());
}

void RodFrames::load_history(const History& history) {
  const std::vector<double>* frames = history_values(history, history_, 4, count());
  for (int e = 0; e < count(); ++e)
    committed_[e] = frames ? Quaternion(Eigen::Map<const Eigen::Vector4d>(frames->data() + 4 * static_cast<size_t>(e))) : at_rest_[e];
}

void RodFrames::begin_step(const StepStart& start) {
  start_ = start.x;
  start_time_ = start.time;
}

void RodFrames::commit(const VecX& x, History& history) const {
  HistoryArray& array = history[history_];
  array = {4, std::vector<double>(4 * edges_.size()), {}};
  for (int e = 0; e < count(); ++e)
    Eigen::Map<Eigen::Vector4d>(array.values.data() + 4 * static_cast<size_t>(e)) = reference(e, x).coeffs();
}

}  // namespace tack
