// SPDX-License-Identifier: MIT
#include "survey/face_splitting.hpp"

#include <cstdint>
#include <numeric>
#include <vector>

namespace cornerd::survey {

std::size_t split_revisited(MappedDrive& drive, std::size_t from_scan, double way_m) {
  const std::vector<double> ways = ways_m(drive);
  const std::size_t known = drive.faces.size();
  std::vector<std::uint32_t> now_of(known);  // what a face is called by now
  std::iota(now_of.begin(), now_of.end(), 0);
  std::vector<std::uint32_t> last_seen(known, kNoFace);
  for (Observation& observation : drive.observations) {
    const std::uint32_t face = observation.face;
    const std::uint32_t last = last_seen[face];
    last_seen[face] = observation.scan;
    if (last != kNoFace && observation.scan >= from_scan &&
        ways[observation.scan] - ways[last] > way_m) {
      now_of[face] = static_cast<std::uint32_t>(drive.faces.size());
      drive.faces.push_back(drive.faces[face]);
    }
    observation.face = now_of[face];
  }
  if (drive.faces.size() > known) measure_faces(drive);
  return drive.faces.size() - known;
}

}  // namespace cornerd::survey
