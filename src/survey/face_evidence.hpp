// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/sensor_noise.hpp"
#include "survey/drive_mapper.hpp"

namespace cornerd::survey {

/// Ray counts of a whole drive in cells along the line of one face: hits (rays that ended on it)
/// and passes (rays that went through it).
class FaceEvidence {
 public:
  static constexpr double kCell_m = 0.02;
  /// The cells extend beyond both ends of the observed face.
  static constexpr double kBeyond_m = 0.4;

  explicit FaceEvidence(const LineLandmark& face);

  double begin_m() const { return begin_m_; }
  double end_m() const { return begin_m_ + kCell_m * static_cast<double>(cells_.size()); }
  std::size_t size() const { return cells_.size(); }
  /// Begin of a cell along the face.
  double along_of(std::size_t cell) const { return begin_m_ + kCell_m * static_cast<double>(cell); }

  void add_hit(double along_m) { add(along_m, &Cell::hits); }
  void add_pass(double along_m) { add(along_m, &Cell::passes); }

  std::uint32_t hits(std::size_t cell) const { return cells_[cell].hits; }
  std::uint32_t passes(std::size_t cell) const { return cells_[cell].passes; }
  /// Of the cell at a coordinate along the face; 0 beyond the ends.
  std::uint32_t hits_at(double along_m) const;
  bool is_wall(std::size_t cell) const;
  bool is_open(std::size_t cell) const;
  /// Length between two coordinates that rays went through, metres.
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

/// Casts all rays of the drive through all faces. Linear in the number of rays.
std::vector<FaceEvidence> gather_evidence(const MappedDrive& drive, const core::SensorNoise& noise,
                                          const Progress& progress);

}  // namespace cornerd::survey
