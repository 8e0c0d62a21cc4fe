#include "framework/contact/clipped/plane_polygon.hpp"

namespace tack {

void cut_polygon(const PlanePolygon& polygon, const double* distance, const bool* beyond, int curve, PlanePolygon& kept,
                 PlanePolygon* rest) {
  kept.clear();
  if (rest) rest->clear();
  for (int i = 0; i < polygon.size(); ++i) {
    const int j = i + 1 < polygon.size() ? i + 1 : 0;
    const PlaneCorner &from = polygon[i], &to = polygon[j];
    if (beyond[i]) kept.add(from);
    else if (rest) rest->add(from);
    if (beyond[i] == beyond[j]) continue;
    const double difference = distance[i] - distance[j], t = difference == 0 ? 0 : distance[i] / difference;
    PlaneCorner crossing;
    crossing.x = from.x + t * (to.x - from.x);
    crossing.y = from.y + t * (to.y - from.y);
    crossing.gap = from.gap + t * (to.gap - from.gap);
    for (int k = 0; k < 3; ++k) crossing.share[k] = from.share[k] + t * (to.share[k] - from.share[k]);
    // A crossing at a corner that is tied to the line has the place of that corner, and its ties.
    const int line = curve - PlaneSide::line_of_b;
    const auto tied = [&](const PlaneCorner& corner) { return line >= 0 && line < 3 && (corner.ties >> line & 1) != 0; };
    crossing.ties = tied(from) ? from.ties : tied(to) ? to.ties : from.ties & to.ties;
    crossing.along = tied(from) ? from.along : tied(to) ? to.along : from.along & to.along;
    // Leaving a side begins the cut, coming back continues along the old side.
    crossing.side = beyond[i] ? curve : from.side;
    kept.add(crossing);
    crossing.side = beyond[i] ? from.side : curve;
    if (rest) rest->add(crossing);
  }
  if (kept.size() < 3) kept.clear();
  if (rest && rest->size() < 3) rest->clear();
}

}  // namespace tack
