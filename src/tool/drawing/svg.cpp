// SPDX-License-Identifier: MIT
#include "tool/drawing/svg.hpp"

#include <charconv>
#include <cmath>

namespace cornerd::tool {

namespace {

/// Rounded to a hundredth of a pixel, without trailing zeros, independent of the locale.
void append_number(std::string& out, double value) {
  const double rounded = std::round(value * 100) / 100;
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, rounded == 0 ? 0.0 : rounded,
                                 std::chars_format::fixed);
  out.append(digits, end.ptr);
}

void append_attribute(std::string& out, std::string_view name, std::string_view value) {
  out += ' ';
  out += name;
  out += "=\"";
  out += escape_xml(value);
  out += '"';
}

}  // namespace

std::string escape_xml(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r') {
          out += "\xEF\xBF\xBD";
        } else {
          out += c;
        }
    }
  }
  return out;
}

Svg::Svg(const core::Vec2& lower_left, const core::Vec2& upper_right, double pixels_per_m,
         double margin_px)
    : lower_left_(lower_left),
      pixels_per_m_(pixels_per_m),
      margin_px_(margin_px),
      width_px_((upper_right.x() - lower_left.x()) * pixels_per_m + 2 * margin_px),
      height_px_((upper_right.y() - lower_left.y()) * pixels_per_m + 2 * margin_px) {}

core::Vec2 Svg::to_pixels(const core::Vec2& point_m) const {
  const core::Vec2 offset = (point_m - lower_left_) * pixels_per_m_;
  return {margin_px_ + offset.x(), height_px_ - margin_px_ - offset.y()};
}

void Svg::number(double value) { append_number(body_, value); }

void Svg::attribute(std::string_view name, double value) {
  body_ += ' ';
  body_ += name;
  body_ += "=\"";
  number(value);
  body_ += '"';
}

void Svg::paint(const Paint& paint) {
  append_attribute(body_, "fill", paint.fill);
  if (paint.stroke != "none") {
    append_attribute(body_, "stroke", paint.stroke);
    attribute("stroke-width", paint.stroke_width);
    body_ += " stroke-linejoin=\"round\" stroke-linecap=\"round\"";
  }
  if (!paint.dashes.empty()) append_attribute(body_, "stroke-dasharray", paint.dashes);
  if (paint.opacity < 1) attribute("opacity", paint.opacity);
}

void Svg::points(std::string_view element, std::span<const core::Vec2> points, const Paint& style) {
  body_ += '<';
  body_ += element;
  body_ += " points=\"";
  for (const core::Vec2& point : points) {
    const core::Vec2 at = to_pixels(point);
    number(at.x());
    body_ += ',';
    number(at.y());
    body_ += ' ';
  }
  if (!points.empty()) body_.pop_back();
  body_ += '"';
  paint(style);
  body_ += "/>\n";
}

void Svg::polygon(std::span<const core::Vec2> points_m, const Paint& style) {
  points("polygon", points_m, style);
}

void Svg::polyline(std::span<const core::Vec2> points_m, const Paint& style) {
  points("polyline", points_m, style);
}

void Svg::line(const core::Vec2& from, const core::Vec2& to, const Paint& style) {
  const core::Vec2 ends[] = {from, to};
  polyline(ends, style);
}

void Svg::dot(const core::Vec2& center, double radius_px, const Paint& style) {
  const core::Vec2 at = to_pixels(center);
  body_ += "<circle";
  attribute("cx", at.x());
  attribute("cy", at.y());
  attribute("r", radius_px);
  paint(style);
  body_ += "/>\n";
}

void Svg::ellipse(const core::Vec2& center, double first_m, double second_m, double rotation_rad,
                  const Paint& style) {
  const core::Vec2 at = to_pixels(center);
  body_ += "<ellipse";
  attribute("rx", first_m * pixels_per_m_);
  attribute("ry", second_m * pixels_per_m_);
  body_ += " transform=\"translate(";
  number(at.x());
  body_ += ' ';
  number(at.y());
  body_ += ") rotate(";
  number(-core::degrees(rotation_rad));
  body_ += ")\"";
  paint(style);
  body_ += "/>\n";
}

void Svg::text(const core::Vec2& at_m, std::string_view content, const TextStyle& style,
               double right_px, double down_px) {
  const core::Vec2 at = to_pixels(at_m) + core::Vec2(right_px, down_px);
  body_ += "<text";
  attribute("x", at.x());
  attribute("y", at.y());
  append_attribute(body_, "fill", style.fill);
  attribute("font-size", style.size);
  append_attribute(body_, "text-anchor", style.anchor);
  if (style.bold) body_ += " font-weight=\"bold\"";
  if (style.rotation_deg != 0) {
    body_ += " transform=\"rotate(";
    number(-style.rotation_deg);
    body_ += ' ';
    number(at.x());
    body_ += ' ';
    number(at.y());
    body_ += ")\"";
  }
  body_ += '>';
  body_ += escape_xml(content);
  body_ += "</text>\n";
}

void Svg::begin_group(std::string_view id) {
  body_ += "<g";
  append_attribute(body_, "id", id);
  body_ += ">\n";
}

void Svg::end_group() { body_ += "</g>\n"; }

std::string Svg::document(std::string_view title) const {
  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"";
  append_number(out, width_px_);
  out += "\" height=\"";
  append_number(out, height_px_);
  out += "\" viewBox=\"0 0 ";
  append_number(out, width_px_);
  out += ' ';
  append_number(out, height_px_);
  out += "\" font-family=\"Helvetica, Arial, sans-serif\">\n<title>";
  out += escape_xml(title);
  out += "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  out += body_;
  out += "</svg>\n";
  return out;
}

}  // namespace cornerd::tool
