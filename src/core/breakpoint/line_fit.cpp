// SPDX-License-Identifier: MIT
#include "core/breakpoint/line_fit.hpp"

#include <algorithm>

namespace cornerd::core {

void LineFit::add(const LineFit& other) {
  const Vec2 shift = other.origin_ - origin_;
  x_ += other.x_ + other.w_ * shift.x();
  y_ += other.y_ + other.w_ * shift.y();
  xx_ += other.xx_ + 2 * shift.x() * other.x_ + other.w_ * shift.x() * shift.x();
  xy_ += other.xy_ + shift.x() * other.y_ + shift.y() * other.x_ + other.w_ * shift.x() * shift.y();
  yy_ += other.yy_ + 2 * shift.y() * other.y_ + other.w_ * shift.y() * shift.y();
  w_ += other.w_;
  count_ += other.count_;
}

void LineFit::add(const PointSums& sums, int count, double weight) {
  const double n = count;
  const double ox = origin_.x();
  const double oy = origin_.y();
  w_ += weight * n;
  x_ += weight * (sums.x - n * ox);
  y_ += weight * (sums.y - n * oy);
  xx_ += weight * (sums.xx - ox * (2 * sums.x - n * ox));
  xy_ += weight * (sums.xy - ox * sums.y - oy * (sums.x - n * ox));
  yy_ += weight * (sums.yy - oy * (2 * sums.y - n * oy));
  count_ += count;
}

LineFit LineFit::without(const LineFit& part) const {
  LineFit rest = *this;
  rest.w_ -= part.w_;
  rest.x_ -= part.x_;
  rest.y_ -= part.y_;
  rest.xx_ -= part.xx_;
  rest.xy_ -= part.xy_;
  rest.yy_ -= part.yy_;
  rest.count_ -= part.count_;
  return rest;
}

LineFit::Moments LineFit::moments() const {
  const double mx = x_ / w_;
  const double my = y_ / w_;
  return {{mx, my}, xx_ / w_ - mx * mx, xy_ / w_ - mx * my, yy_ / w_ - my * my};
}

Line LineFit::line() const {
  const Moments m = moments();
  // Direction of the larger eigenvector of the scatter, by the half-angle formulas.
  const double d = m.xx - m.yy;
  const double h = std::sqrt(d * d + 4 * m.xy * m.xy);
  const double cos2 = h > 0 ? d / h : 1;
  double dx = std::sqrt(std::max(0.0, (1 + cos2) / 2));
  double dy = std::sqrt(std::max(0.0, (1 - cos2) / 2));
  if (m.xy < 0) dx = -dx;
  Line line;
  line.centroid = m.mean + origin_;
  line.normal = {-dy, dx};
  line.offset_m = line.normal.dot(line.centroid);
  if (line.offset_m > 0) {
    line.normal = -line.normal;
    line.offset_m = -line.offset_m;
  }
  line.weight = w_;
  line.variance_along = std::max((m.xx + m.yy + h) / 2, 1e-12);
  return line;
}

double LineFit::chi_square() const {
  const Moments m = moments();
  const double d = m.xx - m.yy;
  const double h = std::sqrt(d * d + 4 * m.xy * m.xy);
  return std::max(0.0, w_ * (m.xx + m.yy - h) / 2);
}

}  // namespace cornerd::core
