// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/geometry/pose2.hpp"

namespace cornerd::tool {

/// Colours of every drawing: walls, axes and text; the lines of a grid.
inline constexpr std::string_view kInk = "#2f3640";
inline constexpr std::string_view kGridInk = "#e9e6df";

/// Style of a shape: SVG colours ("#2f3640", "none"), widths in pixels.
struct Paint {
  std::string_view fill = "none";
  std::string_view stroke = "none";
  double stroke_width = 1;
  double opacity = 1;
  std::string_view dashes = {};  ///< stroke-dasharray; empty: solid
};

struct TextStyle {
  std::string_view fill = "#000000";
  double size = 12;                    ///< pixels
  std::string_view anchor = "middle";  ///< or start, end
  bool bold = false;
  double rotation_deg = 0;  ///< counter-clockwise
};

/// An SVG drawing of a rectangle of the plane. Coordinates are in metres with y upwards; widths,
/// text sizes and text offsets are in pixels. Offsets have y downwards.
class Svg {
 public:
  /// The rectangle between the two corners, with a margin of `margin_px` around it.
  Svg(const core::Vec2& lower_left, const core::Vec2& upper_right, double pixels_per_m,
      double margin_px);

  void polygon(std::span<const core::Vec2> points, const Paint& paint);
  void polyline(std::span<const core::Vec2> points, const Paint& paint);
  void line(const core::Vec2& from, const core::Vec2& to, const Paint& paint);
  void dot(const core::Vec2& center, double radius_px, const Paint& paint);
  /// Semi-axes in metres; `rotation_rad`: of the first axis, counter-clockwise from x.
  void ellipse(const core::Vec2& center, double first_m, double second_m, double rotation_rad,
               const Paint& paint);
  void text(const core::Vec2& at, std::string_view text, const TextStyle& style,
            double right_px = 0, double down_px = 0);

  /// Elements up to end_group() share an id, for editing the drawing.
  void begin_group(std::string_view id);
  void end_group();

  /// Size of the page, for frames and scale bars.
  double pixels_per_m() const { return pixels_per_m_; }
  double width_px() const { return width_px_; }
  double height_px() const { return height_px_; }

  /// The complete document. `title`: of a browser's tab.
  std::string document(std::string_view title) const;

 private:
  core::Vec2 to_pixels(const core::Vec2& point_m) const;
  void points(std::string_view element, std::span<const core::Vec2> points, const Paint& paint);
  void paint(const Paint& paint);
  void number(double value);
  void attribute(std::string_view name, double value);

  core::Vec2 lower_left_;
  double pixels_per_m_;
  double margin_px_;
  double width_px_;
  double height_px_;
  std::string body_;
};

/// Escapes text for an XML element or attribute: the five special characters as entities, control
/// characters (not allowed in XML 1.0, section 2.2) as U+FFFD.
std::string escape_xml(std::string_view text);

}  // namespace cornerd::tool
