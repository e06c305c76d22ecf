// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/sensor_noise.hpp"
#include "survey/drive_mapper.hpp"

namespace cornerd::survey {

/// What the rays of a whole drive say of the line of one face, in cells along it: how many ended on
/// it, and how many went through.
class FaceEvidence {
 public:
  static constexpr double kCell_m = 0.02;
  /// The line is looked at beyond both ends of what was sighted.
  static constexpr double kBeyond_m = 0.4;

  explicit FaceEvidence(const MappedFace& face);

  double begin_m() const { return begin_m_; }
  double end_m() const { return begin_m_ + kCell_m * static_cast<double>(cells_.size()); }
  std::size_t size() const { return cells_.size(); }
  /// Place of a cell's beginning along the face.
  double along_of(std::size_t cell) const { return begin_m_ + kCell_m * static_cast<double>(cell); }

  void add_hit(double along_m) { add(along_m, &Cell::hits); }
  void add_pass(double along_m) { add(along_m, &Cell::passes); }

  std::uint32_t hits(std::size_t cell) const { return cells_[cell].hits; }
  std::uint32_t passes(std::size_t cell) const { return cells_[cell].passes; }
  /// Of the cell at a place along the face; 0 beyond the ends.
  std::uint32_t hits_at(double along_m) const;
  bool is_wall(std::size_t cell) const;
  bool is_open(std::size_t cell) const;
  /// Metres between two places that rays went through.
  double open_between(double from_m, double to_m) const;

 private:
  struct Cell {
    std::uint32_t hits = 0;
    std::uint32_t passes = 0;
  };
  void add(double along_m, std::uint32_t Cell::*count);

  double begin_m_;
  std::vector<Cell> cells_;
};

/// Sends all rays of the drive through all faces. Linear in the rays.
std::vector<FaceEvidence> gather_evidence(const MappedDrive& drive, const core::SensorNoise& noise,
                                          const Progress& progress);

}  // namespace cornerd::survey
