// SPDX-License-Identifier: MIT
#include "plan/svg_reader.hpp"

#ifdef CORNERD_HAS_PUGIXML

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <string>

#include "plan/svg_text.hpp"

namespace cornerd::plan {

namespace {

using core::Vec2;

/// Drawing programs nest some ten groups.
constexpr int kMaxGroupDepth = 200;

/// What a group hands down.
struct Context {
  Affine to_drawing;
  bool is_chosen = false;
  std::string layer;
  int depth = 0;
};

class SvgReader {
 public:
  explicit SvgReader(const LayerChoice& layers) : choice_(layers) {}

  Drawing read(const pugi::xml_node& root) {
    Context context;
    // SVG's y points down.
    context.to_drawing.matrix = Vec2(1, -1).asDiagonal();
    context.is_chosen = choice_.empty();
    read_size(root, context);
    read_children(root, context);
    return std::move(drawing_);
  }

 private:
  static double number_of(const pugi::xml_node& node, const char* name) {
    const std::vector<double> values = number_list(node.attribute(name).value());
    return values.empty() ? 0 : values.front();
  }

  /// The size of a user unit, and the upper left corner of the picture.
  void read_size(const pugi::xml_node& root, Context& context) {
    const std::vector<double> box = number_list(root.attribute("viewBox").value());
    const bool has_box = box.size() == 4 && box[2] > 0 && box[3] > 0;
    const auto width_m = parse_length(root.attribute("width").value());
    const auto height_m = parse_length(root.attribute("height").value());
    if (has_box) {
      // Of another shape than the box, the picture is as large as fits (preserveAspectRatio).
      if (width_m) drawing_.metres_per_unit = *width_m / box[2];
      if (height_m) {
        drawing_.metres_per_unit =
            std::min(*height_m / box[3], drawing_.metres_per_unit.value_or(*height_m / box[3]));
      }
      context.to_drawing.offset = {-box[0], box[1] + box[3]};
    } else if (width_m || height_m) {
      // Without a box a user unit is a pixel of CSS.
      drawing_.metres_per_unit = 0.0254 / 96;
    }
  }

  void read_children(const pugi::xml_node& parent, const Context& context) {
    if (context.depth > kMaxGroupDepth) throw PlanError("has groups nested too deep");
    for (const pugi::xml_node& node : parent.children()) {
      if (node.type() == pugi::node_element) read_element(node, context);
    }
  }

  void read_element(const pugi::xml_node& node, Context context) {
    std::string kind = node.name();
    if (kind.starts_with("svg:")) kind.erase(0, 4);
    if (is_hidden(node)) {
      ++drawing_.ignored["hidden " + kind];
      return;
    }
    context.to_drawing = context.to_drawing * parse_transform(node.attribute("transform").value());
    ++context.depth;
    if (kind == "g" || kind == "a" || kind == "switch") {
      enter_layer(node, context);
      read_children(node, context);
    } else if (!read_shape(node, kind, context)) {
      // Names of the drawing program's own are no elements of SVG.
      if (kind.find(':') == std::string::npos && kind != "metadata" && kind != "title" &&
          kind != "defs" && kind != "style" && kind != "desc") {
        ++drawing_.ignored[kind];
      }
    }
  }

  static bool is_hidden(const pugi::xml_node& node) {
    const std::string_view style = node.attribute("style").value();
    return node.attribute("display").value() == std::string_view("none") ||
           node.attribute("visibility").value() == std::string_view("hidden") ||
           style.find("display:none") != std::string_view::npos ||
           style.find("visibility:hidden") != std::string_view::npos;
  }

  void enter_layer(const pugi::xml_node& group, Context& context) {
    bool is_named = false;
    for (const char* attribute : {"inkscape:label", "id"}) {
      const std::string name = group.attribute(attribute).value();
      const bool is_chosen = choice_.contains(name);
      if (name.empty() || (is_named && !is_chosen)) continue;
      context.is_chosen = context.is_chosen || is_chosen;
      context.layer = name;
      drawing_.layers.try_emplace(name, 0);
      is_named = true;
    }
  }

  bool read_shape(const pugi::xml_node& node, const std::string& kind, const Context& context) {
    const auto read_circle = [&](const Vec2& radii) {
      const Vec2 centre(number_of(node, "cx"), number_of(node, "cy"));
      std::vector<Vec2> points = {centre + Vec2(radii.x(), 0)};
      for (const Vec2& point : arc_points({0, 0}, 1, 0, core::kTwoPi)) {
        points.push_back(centre + point.cwiseProduct(radii));
      }
      add(points, context);
    };
    if (kind == "line") {
      add({{number_of(node, "x1"), number_of(node, "y1")},
           {number_of(node, "x2"), number_of(node, "y2")}},
          context);
    } else if (kind == "polyline" || kind == "polygon") {
      const std::vector<double> values = number_list(node.attribute("points").value());
      std::vector<Vec2> points;
      for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
        points.emplace_back(values[i], values[i + 1]);
      }
      if (kind == "polygon" && !points.empty()) points.push_back(points.front());
      add(points, context);
    } else if (kind == "rect") {
      const Vec2 low(number_of(node, "x"), number_of(node, "y"));
      const Vec2 size(number_of(node, "width"), number_of(node, "height"));
      add({low, low + Vec2(size.x(), 0), low + size, low + Vec2(0, size.y()), low}, context);
    } else if (kind == "circle") {
      read_circle(Vec2::Constant(number_of(node, "r")));
    } else if (kind == "ellipse") {
      read_circle({number_of(node, "rx"), number_of(node, "ry")});
    } else if (kind == "path") {
      for (const auto& points : parse_path(node.attribute("d").value())) add(points, context);
    } else {
      return false;
    }
    return true;
  }

  void add(const std::vector<Vec2>& points, const Context& context) {
    if (points.size() < 2) return;
    if (!context.layer.empty()) drawing_.layers[context.layer] += points.size() - 1;
    if (!context.is_chosen) return;
    for (std::size_t i = 1; i < points.size(); ++i) {
      add_line(drawing_, context.to_drawing * points[i - 1], context.to_drawing * points[i]);
    }
  }

  const LayerChoice& choice_;
  Drawing drawing_;
};

}  // namespace

bool has_svg() { return true; }

Drawing read_svg(std::string_view text, const LayerChoice& layers) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  if (!result) {
    throw PlanError("is no XML: " + std::string(result.description()) + " at byte " +
                    std::to_string(result.offset));
  }
  const pugi::xml_node root = document.document_element();
  const std::string name = root.name();
  if (name != "svg" && name != "svg:svg") throw PlanError("is XML, but no SVG");
  Drawing drawing = SvgReader(layers).read(root);
  check_layers(drawing, layers);
  return drawing;
}

}  // namespace cornerd::plan

#else

namespace cornerd::plan {

bool has_svg() { return false; }

Drawing read_svg(std::string_view /*text*/, const LayerChoice& /*layers*/) {
  throw PlanError("SVG cannot be read by this build, which has no pugixml: import on a PC");
}

}  // namespace cornerd::plan

#endif
