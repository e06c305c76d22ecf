// SPDX-License-Identifier: MIT
#include "plan/dxf_reader.hpp"

#ifdef CORNERD_HAS_DXFLIB

#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>

#include <cmath>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>

#include "plan/dxf_pairs.hpp"
#include "plan/svg_text.hpp"

namespace cornerd::plan {

namespace {

using core::Vec2;

/// Blocks within blocks, and how many are placed in all.
constexpr int kMaxBlockDepth = 16;
constexpr std::size_t kMaxInserts = 100'000;

struct Insert {
  std::string block;
  Affine T_outer_block;
};

struct Part {
  std::string layer;
  std::vector<Vec2> points;  ///< of a polyline
  Insert insert;             ///< where there are no points
};

struct Block {
  Vec2 base = Vec2::Zero();
  std::vector<Part> parts;
};

/// Collects what dxflib reports.
class Collector : public DL_CreationAdapter {
 public:
  void setVariableInt(const std::string& name, int value, int /*code*/) override {
    if (name == "$INSUNITS") insert_units = value;
  }
  void addBlock(const DL_BlockData& data) override {
    finish_polyline();
    current_ = &blocks[data.name];
    current_->base = {data.bpx, data.bpy};
  }
  void endBlock() override {
    finish_polyline();
    current_ = &drawing;
  }
  void addLine(const DL_LineData& data) override { add({{data.x1, data.y1}, {data.x2, data.y2}}); }
  void addArc(const DL_ArcData& data) override {
    double sweep_deg = std::fmod(data.angle2 - data.angle1, 360.0);
    if (!(sweep_deg > 0)) sweep_deg += 360;
    add_arc({data.cx, data.cy}, data.radius, data.angle1, sweep_deg);
  }
  void addCircle(const DL_CircleData& data) override {
    add_arc({data.cx, data.cy}, data.radius, 0, 360);
  }
  void addPolyline(const DL_PolylineData& data) override {
    finish_polyline();
    is_closed_ = (data.flags & 1) != 0;
    polyline_layer_ = getAttributes().getLayer();
  }
  void addVertex(const DL_VertexData& data) override {
    vertices_.push_back({{data.x, data.y}, data.bulge});
  }
  void endEntity() override { finish_polyline(); }
  void addInsert(const DL_InsertData& data) override {
    finish_polyline();
    // Rows and columns of a block are for chairs and parking lots.
    Affine T_outer_block;
    const Vec2 x = core::unit_vector(core::radians(data.angle));
    T_outer_block.matrix << x.x() * data.sx, -x.y() * data.sy, x.y() * data.sx, x.x() * data.sy;
    T_outer_block.offset = {data.ipx, data.ipy};
    current_->parts.push_back({getAttributes().getLayer(), {}, {data.name, T_outer_block}});
  }
  void finish_polyline() {
    if (vertices_.size() > 1) {
      std::vector<Vec2> points = {vertices_.front().point};
      for (std::size_t i = 0; i + (is_closed_ ? 0 : 1) < vertices_.size(); ++i) {
        append_segment(vertices_[i], vertices_[(i + 1) % vertices_.size()].point, points);
      }
      current_->parts.push_back({polyline_layer_, std::move(points), {}});
    }
    vertices_.clear();
  }

  Block drawing;
  std::map<std::string, Block> blocks;
  int insert_units = 0;

 private:
  struct Vertex {
    Vec2 point;
    double bulge = 0;  ///< tangent of a quarter of the arc to the next vertex
  };

  static void append_segment(const Vertex& from, const Vec2& to, std::vector<Vec2>& points) {
    const Vec2 chord = to - from.point;
    if (std::abs(from.bulge) > 1e-9 && chord.norm() > 0) {
      const double sweep_rad = 4 * std::atan(from.bulge);
      const Vec2 to_centre =
          chord / 2 + core::rotate_left(chord) / 2 * (1 / from.bulge - from.bulge) / 2;
      const double begin_rad = std::atan2(-to_centre.y(), -to_centre.x());
      const auto arc = arc_points(from.point + to_centre, to_centre.norm(), begin_rad, sweep_rad);
      points.insert(points.end(), arc.begin(), std::prev(arc.end()));
    }
    points.push_back(to);
  }
  void add_arc(const Vec2& centre, double radius, double begin_deg, double sweep_deg) {
    const double begin_rad = core::radians(begin_deg);
    std::vector<Vec2> points = {centre + radius * core::unit_vector(begin_rad)};
    const auto arc = arc_points(centre, radius, begin_rad, core::radians(sweep_deg));
    points.insert(points.end(), arc.begin(), arc.end());
    add(std::move(points));
  }
  void add(std::vector<Vec2> points) {
    finish_polyline();
    current_->parts.push_back({getAttributes().getLayer(), std::move(points), {}});
  }

  Block* current_ = &drawing;
  std::vector<Vertex> vertices_;
  bool is_closed_ = false;
  std::string polyline_layer_;
};

/// Places all blocks.
class Expansion {
 public:
  Expansion(const std::map<std::string, Block>& blocks, const LayerChoice& layers, Drawing& drawing)
      : blocks_(blocks), choice_(layers), drawing_(drawing) {}

  void add(const Block& block, const Affine& T_drawing_block, const std::string& outer_layer,
           int depth) {
    if (depth > kMaxBlockDepth) throw PlanError("has blocks nested too deep, or in themselves");
    for (const Part& part : block.parts) {
      // DXF reference, LAYER: what is on layer 0 of a block takes the layer of its INSERT.
      const std::string& layer = part.layer == "0" && depth > 0 ? outer_layer : part.layer;
      if (part.points.empty()) {
        insert(part.insert, T_drawing_block, layer, depth);
        continue;
      }
      drawing_.layers[layer] += part.points.size() - 1;
      if (!choice_.empty() && !choice_.contains(layer)) continue;
      for (std::size_t i = 1; i < part.points.size(); ++i) {
        add_line(drawing_, T_drawing_block * part.points[i - 1], T_drawing_block * part.points[i]);
      }
    }
  }

 private:
  void insert(const Insert& placed, const Affine& T_drawing_outer, const std::string& layer,
              int depth) {
    if (++inserts_ > kMaxInserts) throw PlanError("places more than 100,000 blocks");
    const auto block = blocks_.find(placed.block);
    if (block == blocks_.end()) {
      ++drawing_.ignored["INSERT of no block"];
      return;
    }
    const Affine to_base{Eigen::Matrix2d::Identity(), -block->second.base};
    add(block->second, T_drawing_outer * placed.T_outer_block * to_base, layer, depth + 1);
  }

  const std::map<std::string, Block>& blocks_;
  const LayerChoice& choice_;
  Drawing& drawing_;
  std::size_t inserts_ = 0;
};

/// DXF reference, HEADER, $INSUNITS.
std::optional<double> metres_of(int insert_units) {
  switch (insert_units) {
    case 1:
      return 0.0254;
    case 2:
      return 0.3048;
    case 4:
      return 1e-3;
    case 5:
      return 1e-2;
    case 6:
      return 1;
    case 14:
      return 0.1;
    default:
      return std::nullopt;
  }
}

}  // namespace

bool has_dxf() { return true; }

Drawing read_dxf(std::string_view text, const LayerChoice& layers) {
  const WallEntities kept = keep_wall_entities(text);
  Collector collector;
  std::istringstream stream(kept.text);
  DL_Dxf dxf;
  if (!dxf.in(stream, &collector)) throw PlanError("is no DXF");
  collector.finish_polyline();
  Drawing drawing;
  drawing.ignored = kept.ignored;
  drawing.metres_per_unit = metres_of(collector.insert_units);
  Expansion(collector.blocks, layers, drawing).add(collector.drawing, {}, "0", 0);
  check_layers(drawing, layers);
  return drawing;
}

}  // namespace cornerd::plan

#else

namespace cornerd::plan {

bool has_dxf() { return false; }

Drawing read_dxf(std::string_view /*text*/, const LayerChoice& /*layers*/) {
  throw PlanError("DXF cannot be read by this build, which has no dxflib: import on a PC");
}

}  // namespace cornerd::plan

#endif
