// SPDX-License-Identifier: MIT
#include "survey/wall_piece.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace cornerd::survey {
namespace {

/// Open cells in a row that make an opening; a single one is pose noise.
constexpr std::size_t kMinOpenCells = 2;

std::string text_of(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what;
}

class Cutter {
 public:
  Cutter(const MappedDrive& drive, std::uint32_t face, const FaceEvidence& evidence,
         const PieceLimits& limits, std::vector<WallPiece>& pieces,
         std::vector<DroppedPiece>& dropped)
      : face_(drive.faces[face]),
        index_(face),
        evidence_(evidence),
        limits_(limits),
        pieces_(pieces),
        dropped_(dropped) {}

  void cut() {
    if (face_.observations < limits_.observations) {
      drop(face_.begin_m(), face_.end_m(), "observed in " + text_of(face_.observations, "scans"));
      return;
    }
    std::size_t open_run = 0;
    std::size_t open_cells = 0;
    for (std::size_t i = 0; i < evidence_.size(); ++i) {
      const bool within =
          evidence_.along_of(i) + FaceEvidence::kCell_m > face_.begin_m() - kSlack_m &&
          evidence_.along_of(i) < face_.end_m() + kSlack_m;
      if (evidence_.is_wall(i) && within) {
        take(i);
        open_run = 0;
      } else if (evidence_.is_open(i)) {
        open_cells += within ? 1 : 0;
        if (++open_run >= kMinOpenCells) close();
      }
    }
    close();
    if (found_ == 0) {
      drop(face_.begin_m(), face_.end_m(),
           open_cells > 0 ? "rays went through it: it moved, or a door was open at times"
                          : "too few rays ended on it");
    }
  }

 private:
  static constexpr double kSlack_m = 0.03;

  void take(std::size_t cell) {
    const double begin_m = evidence_.along_of(cell);
    if (current_ && begin_m - current_->end_m > limits_.gap_m) close();
    if (!current_) {
      current_.emplace();
      current_->face = index_;
      current_->begin_m = begin_m;
    }
    current_->end_m = begin_m + FaceEvidence::kCell_m;
    current_->seen_m += FaceEvidence::kCell_m;
    current_->hits += evidence_.hits(cell);
  }

  void close() {
    if (!current_) return;
    WallPiece piece = *std::exchange(current_, std::nullopt);
    // A cell at either end counts as wall as soon as a few rays hit a part of it.
    piece.begin_m = std::max(piece.begin_m, face_.begin_m());
    piece.end_m = std::min(piece.end_m, face_.end_m());
    ++found_;
    const std::string reason = reason_to_drop(piece);
    if (!reason.empty()) {
      if (piece.length_m() > 0) drop(piece.begin_m, piece.end_m, reason);
      return;
    }
    piece.begin.point = face_.at(piece.begin_m);
    piece.end.point = face_.at(piece.end_m);
    pieces_.push_back(piece);
  }

  /// Why the piece is no wall; empty where it is one.
  std::string reason_to_drop(const WallPiece& piece) const {
    if (piece.hits < limits_.hits) return "hit by " + text_of(piece.hits, "rays");
    if (piece.length_m() < limits_.least_m) return "too short";
    if (piece.seen_m < limits_.seen_share * piece.length_m()) return "most of it has no returns";
    return {};
  }

  void drop(double begin_m, double end_m, std::string why) {
    dropped_.push_back({face_.at(begin_m), face_.at(end_m), std::move(why)});
  }

  const LineLandmark& face_;
  std::uint32_t index_;
  const FaceEvidence& evidence_;
  const PieceLimits& limits_;
  std::vector<WallPiece>& pieces_;
  std::vector<DroppedPiece>& dropped_;
  std::optional<WallPiece> current_;
  std::size_t found_ = 0;
};

}  // namespace

std::vector<WallPiece> cut_pieces(const MappedDrive& drive,
                                  const std::vector<FaceEvidence>& evidence,
                                  const PieceLimits& limits, std::vector<DroppedPiece>& dropped) {
  std::vector<WallPiece> pieces;
  for (std::size_t i = 0; i < drive.faces.size(); ++i) {
    Cutter(drive, static_cast<std::uint32_t>(i), evidence[i], limits, pieces, dropped).cut();
  }
  return pieces;
}

void trim_crossings(const MappedDrive& drive, const PieceLimits& limits,
                    std::vector<WallPiece>& pieces, std::vector<DroppedPiece>& dropped) {
  const double small_sine = std::sin(core::radians(30));
  // Pieces with more hits stay unchanged.
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const WallPiece& a, const WallPiece& b) { return a.hits > b.hits; });
  std::vector<WallPiece> kept;
  for (WallPiece& piece : pieces) {
    const LineLandmark& face = drive.faces[piece.face];
    const double whole_m = piece.length_m();
    bool mistaken = false;
    for (const WallPiece& better : kept) {
      const LineLandmark& other = drive.faces[better.face];
      const double sine = core::cross(face.direction(), other.direction());
      if (std::abs(sine) < 1e-6) continue;
      const double along_m = core::cross(other.at(0) - face.at(0), other.direction()) / sine;
      const double along_other_m = other.along_of(face.at(along_m));
      // Excludes corners, where both end within their cells.
      constexpr double kInside_m = 0.06;
      const bool crosses =
          along_m > piece.begin_m + kInside_m && along_m < piece.end_m - kInside_m &&
          along_other_m > better.begin_m + kInside_m && along_other_m < better.end_m - kInside_m;
      if (!crosses) continue;
      if (std::abs(sine) < small_sine) {
        mistaken = true;
      } else {
        // Cut the end that lies behind the other face.
        (sine < 0 ? piece.begin_m : piece.end_m) = along_m;
      }
    }
    if (mistaken || piece.length_m() < limits.least_m) {
      dropped.push_back({face.at(piece.begin_m), face.at(piece.end_m),
                         mistaken ? "a wrong line along a wall" : "behind a wall"});
      continue;
    }
    if (piece.length_m() < whole_m) {
      piece.begin.point = face.at(piece.begin_m);
      piece.end.point = face.at(piece.end_m);
    }
    kept.push_back(piece);
  }
  pieces = std::move(kept);
}

void mark_open_ends(const std::vector<FaceEvidence>& evidence, std::vector<WallPiece>& pieces) {
  constexpr double kBeside_m = 0.15;
  constexpr double kLeastOpen_m = kMinOpenCells * FaceEvidence::kCell_m;
  for (WallPiece& piece : pieces) {
    const auto is_seen = [&](double from_m, double to_m) {
      return evidence[piece.face].open_between(from_m, to_m) >= kLeastOpen_m;
    };
    piece.begin.is_open =
        piece.begin.neighbour == kNoPiece && !is_seen(piece.begin_m - kBeside_m, piece.begin_m);
    piece.end.is_open =
        piece.end.neighbour == kNoPiece && !is_seen(piece.end_m, piece.end_m + kBeside_m);
  }
}

void drop_isolated(const MappedDrive& drive, const PieceLimits& limits,
                   std::vector<WallPiece>& pieces, std::vector<DroppedPiece>& dropped) {
  std::vector<std::uint32_t> place(pieces.size(), kNoPiece);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const WallPiece& piece = pieces[i];
    const bool adjoined = piece.begin.neighbour != kNoPiece || piece.end.neighbour != kNoPiece;
    if (!adjoined && piece.length_m() < limits.isolated_m) {
      const LineLandmark& face = drive.faces[piece.face];
      dropped.push_back({face.at(piece.begin_m), face.at(piece.end_m), "short and isolated"});
      continue;
    }
    place[i] = static_cast<std::uint32_t>(kept);
    if (kept != i) pieces[kept] = piece;
    ++kept;
  }
  pieces.resize(kept);
  for (WallPiece& piece : pieces) {
    for (PieceEnd* end : {&piece.begin, &piece.end}) {
      if (end->neighbour != kNoPiece) end->neighbour = place[end->neighbour];
    }
  }
}

}  // namespace cornerd::survey
