// SPDX-License-Identifier: MIT
#include "plan/dxf_pairs.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "plan/drawing.hpp"

namespace cornerd::plan {

namespace {

constexpr std::size_t kMaxLineBytes = 1000;
constexpr std::array kKept = {"LINE", "LWPOLYLINE", "POLYLINE", "VERTEX", "SEQEND",
                              "ARC",  "CIRCLE",     "INSERT",   "BLOCK",  "ENDBLK"};
constexpr int kKind = 0;
constexpr int kName = 2;
constexpr int kInPaperSpace = 67;
constexpr int kVertices = 90;

/// A group code and its value, each on a line.
struct Pair {
  int code = 0;
  std::string_view value;
};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r";
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

class PairReader {
 public:
  explicit PairReader(std::string_view text) : text_(text) {}

  std::optional<Pair> next() {
    if (text_.empty()) return std::nullopt;
    const std::string_view code = line();
    if (code.empty() && text_.empty()) return std::nullopt;
    Pair pair;
    const auto [end, error] = std::from_chars(code.data(), code.data() + code.size(), pair.code);
    if (error != std::errc{} || end != code.data() + code.size() || pair.code < 0) {
      throw PlanError("line " + std::to_string(lines_) +
                      " is no group code of DXF: save the drawing as ASCII DXF");
    }
    pair.value = line();
    return pair;
  }

  std::size_t lines() const { return lines_; }

 private:
  std::string_view line() {
    ++lines_;
    const std::size_t end = text_.find('\n');
    const std::string_view line = trimmed(text_.substr(0, end));
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    if (line.size() > kMaxLineBytes) {
      throw PlanError("line " + std::to_string(lines_) + " is longer than 1,000 characters");
    }
    return line;
  }

  std::string_view text_;
  std::size_t lines_ = 0;
};

void append(std::string& text, const Pair& pair) {
  text.append(std::to_string(pair.code)).append("\n").append(pair.value).append("\n");
}

/// An entity until the next one begins.
struct Entity {
  std::string kind;
  std::string text;
  bool is_on_paper = false;
};

class Filter {
 public:
  explicit Filter(std::string_view text) : reader_(text) {}

  WallEntities run() {
    while (const std::optional<Pair> pair = reader_.next()) take(*pair);
    end_entity();
    append(result_.text, {kKind, "EOF"});
    if (!has_section_) throw PlanError("has no section: it is no DXF");
    return std::move(result_);
  }

 private:
  void take(const Pair& pair) {
    if (pair.code == kKind) {
      end_entity();
      begin(pair);
    } else if (awaits_name_ && pair.code == kName) {
      awaits_name_ = false;
      section_ = pair.value;
      append(result_.text, pair);
    } else if (section_ == "HEADER") {
      append(result_.text, pair);
    } else if (!entity_.kind.empty()) {
      if (pair.code == kInPaperSpace && pair.value == "1") entity_.is_on_paper = true;
      if (pair.code == kVertices && entity_.kind == "LWPOLYLINE") check_count(pair.value);
      append(entity_.text, pair);
    }
  }

  void begin(const Pair& pair) {
    if (pair.value == "SECTION") {
      has_section_ = awaits_name_ = true;
      append(result_.text, pair);
    } else if (pair.value == "ENDSEC") {
      section_ = {};
      append(result_.text, pair);
    } else if (section_ == "ENTITIES" || section_ == "BLOCKS") {
      entity_.kind = pair.value;
      append(entity_.text, pair);
    }
  }

  void end_entity() {
    if (entity_.kind.empty()) return;
    if (std::find(kKept.begin(), kKept.end(), entity_.kind) == kKept.end()) {
      ++result_.ignored[entity_.kind];
    } else if (entity_.is_on_paper) {
      ++result_.ignored["on paper: " + entity_.kind];
    } else {
      result_.text += entity_.text;
    }
    entity_ = {};
  }

  void check_count(std::string_view value) const {
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), count);
    if (error != std::errc{} || end != value.data() + value.size() || count > kMaxLines) {
      throw PlanError("line " + std::to_string(reader_.lines()) +
                      ": a number of vertices from 0 to " + std::to_string(kMaxLines) +
                      " must stand here");
    }
  }

  PairReader reader_;
  WallEntities result_;
  std::string_view section_;
  bool awaits_name_ = false;
  bool has_section_ = false;
  Entity entity_;
};

}  // namespace

WallEntities keep_wall_entities(std::string_view text) {
  if (text.starts_with("AutoCAD Binary DXF")) {
    throw PlanError("is a binary DXF: save the drawing as ASCII DXF");
  }
  if (text.starts_with("AC10")) throw PlanError("is a DWG: save the drawing as ASCII DXF");
  return Filter(text).run();
}

}  // namespace cornerd::plan
