// SPDX-License-Identifier: MIT
// Path data: https://www.w3.org/TR/SVG2/paths.html#PathData
#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "plan/drawing.hpp"
#include "plan/svg_text.hpp"

namespace cornerd::plan {

namespace {

using core::Vec2;
using Path = std::vector<Vec2>;

class PathReader {
 public:
  explicit PathReader(std::string_view text) : reader_(text) {}

  std::vector<Path> read() {
    char command = '\0';
    while (reader_.peek() != '\0') {
      if (!reader_.has_number()) {
        command = reader_.peek();
        reader_.skip();
      } else if (command == 'Z' || command == 'z' || command == '\0') {
        throw PlanError("path data: a number where a command must be");
      } else if (command == 'M' || command == 'm') {
        command = command == 'M' ? 'L' : 'l';  // more points of a moveto are linetos
      }
      run(command);
    }
    return std::move(paths_);
  }

 private:
  void run(char command) {
    is_relative_ = std::islower(static_cast<unsigned char>(command)) != 0;
    const char name = static_cast<char>(std::toupper(static_cast<unsigned char>(command)));
    if (paths_.empty() && name != 'M') throw PlanError("path data: must begin with M");
    if (points_ > kMaxLines) throw PlanError("path data: too many points");
    // A curve's first control point mirrors the last one of a curve of its kind.
    if (name != 'S' && name != 'C') cubic_ = at_;
    if (name != 'T' && name != 'Q') quadratic_ = at_;
    switch (name) {
      case 'M':
        start_ = at_ = point();
        paths_.push_back({at_});
        break;
      case 'L':
        line_to(point());
        break;
      case 'H':
        line_to({reader_.number() + (is_relative_ ? at_.x() : 0), at_.y()});
        break;
      case 'V':
        line_to({at_.x(), reader_.number() + (is_relative_ ? at_.y() : 0)});
        break;
      case 'Z':
        line_to(start_);
        paths_.push_back({start_});
        break;
      case 'C':
      case 'S': {
        const Vec2 first = name == 'C' ? point() : Vec2(2 * at_ - cubic_);
        const Vec2 second = point();
        curve_to(first, second, point());
        cubic_ = second;
        break;
      }
      case 'Q':
      case 'T': {
        const Vec2 control = name == 'Q' ? point() : Vec2(2 * at_ - quadratic_);
        const Vec2 end = point();
        curve_to(at_ + (control - at_) * 2 / 3, end + (control - end) * 2 / 3, end);
        quadratic_ = control;
        break;
      }
      case 'A':
        arc();
        break;
      default:
        throw PlanError("path data: an unknown command");
    }
  }

  Vec2 point() {
    const double x = reader_.number();
    const Vec2 read(x, reader_.number());
    return is_relative_ ? Vec2(at_ + read) : read;
  }

  void line_to(const Vec2& end) {
    paths_.back().push_back(end);
    ++points_;
    at_ = end;
  }

  void curve_to(const Vec2& first, const Vec2& second, const Vec2& end) {
    const Vec2 begin = at_;
    for (int i = 1; i <= kChordsOfACurve; ++i) {
      const double t = static_cast<double>(i) / kChordsOfACurve;
      const double u = 1 - t;
      line_to(u * u * u * begin + 3 * u * u * t * first + 3 * u * t * t * second + t * t * t * end);
    }
  }

  /// https://www.w3.org/TR/SVG2/implnote.html#ArcImplementationNotes, from the ends to the centre.
  void arc() {
    Vec2 radii(std::abs(reader_.number()), 0);
    radii.y() = std::abs(reader_.number());
    const double tilt_rad = core::radians(reader_.number());
    const bool is_large = reader_.flag();
    const bool is_positive = reader_.flag();
    const Vec2 begin = at_;
    const Vec2 end = point();
    if (!(radii.minCoeff() > 0) || begin == end) return line_to(end);
    // In axes where the ellipse is a circle of radius 1.
    const Vec2 axis = core::unit_vector(tilt_rad);
    Eigen::Matrix2d tilt;
    tilt << axis.x(), -axis.y(), axis.y(), axis.x();
    const Vec2 half = (tilt.transpose() * (end - begin) / 2).cwiseQuotient(radii);
    const double length = half.norm();
    if (!std::isfinite(length)) throw PlanError("path data: an arc that is too large");
    if (length > 1) radii *= length;
    const Vec2 unit_half = length > 1 ? Vec2(half / length) : half;
    const double aside = std::sqrt(std::max(0.0, 1 / unit_half.squaredNorm() - 1));
    const Vec2 to_centre =
        unit_half + (is_large == is_positive ? -aside : aside) * core::rotate_left(unit_half);
    const double begin_rad = std::atan2(-to_centre.y(), -to_centre.x());
    const Vec2 from_centre = 2 * unit_half - to_centre;
    double sweep_rad = core::angle_between(begin_rad, std::atan2(from_centre.y(), from_centre.x()));
    if (is_positive && sweep_rad < 0) sweep_rad += core::kTwoPi;
    if (!is_positive && sweep_rad > 0) sweep_rad -= core::kTwoPi;
    for (const Vec2& on_circle : arc_points(to_centre, 1, begin_rad, sweep_rad)) {
      line_to(begin + tilt * on_circle.cwiseProduct(radii));
    }
    paths_.back().back() = at_ = end;
  }

  NumberReader reader_;
  std::vector<Path> paths_;
  std::size_t points_ = 0;
  bool is_relative_ = false;
  Vec2 at_ = Vec2::Zero();
  Vec2 start_ = Vec2::Zero();
  Vec2 cubic_ = Vec2::Zero();
  Vec2 quadratic_ = Vec2::Zero();
};

}  // namespace

std::vector<std::vector<Vec2>> parse_path(std::string_view text) { return PathReader(text).read(); }

}  // namespace cornerd::plan
