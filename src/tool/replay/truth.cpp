// SPDX-License-Identifier: MIT
#include "tool/replay/truth.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <variant>

#include "tool/command_line/failure.hpp"

namespace cornerd::tool {

namespace {

constexpr core::TimeNs kHoldLast_ns = core::kNsPerSecond / 5;

}  // namespace

core::Pose2 interpolate(const core::Pose2& from, const core::Pose2& to, double share) {
  const core::Vec2 at = from.translation() + share * (to.translation() - from.translation());
  const double rotation_rad = core::angle_between(from.theta_rad, to.theta_rad);
  return {at.x(), at.y(), core::normalize_angle(from.theta_rad + share * rotation_rad)};
}

Truth Truth::load(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw Failure(file.string() + ": " + std::strerror(errno));

  std::vector<message::RecordedTruth> points;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    const auto fail = [&](const std::string& reason) {
      throw Failure(file.string() + ":" + std::to_string(number) + ": " + reason);
    };
    if (line.empty()) continue;
    const auto parsed = message::parse_truth_line(line);
    if (const auto* error = std::get_if<message::RequestError>(&parsed)) fail(error->text);
    const auto& point = std::get<message::RecordedTruth>(parsed);
    if (!points.empty() && point.t_ns < points.back().t_ns) fail("t goes back in time");
    points.push_back(point);
  }
  if (points.empty()) throw Failure(file.string() + ": holds no pose");
  return Truth(std::move(points));
}

std::optional<core::Pose2> Truth::at(core::TimeNs t_ns) const {
  const auto after =
      std::upper_bound(points_.begin(), points_.end(), t_ns,
                       [](core::TimeNs t, const auto& point) { return t < point.t_ns; });
  if (after == points_.begin()) return std::nullopt;
  const auto& before = *std::prev(after);
  if (after == points_.end()) {
    if (t_ns > before.t_ns + kHoldLast_ns) return std::nullopt;
    return before.T_map_base;
  }
  const double share =
      static_cast<double>(t_ns - before.t_ns) / static_cast<double>(after->t_ns - before.t_ns);
  return interpolate(before.T_map_base, after->T_map_base, share);
}

}  // namespace cornerd::tool
