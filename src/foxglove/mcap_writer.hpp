// SPDX-License-Identifier: MIT
// A file of timed messages: mcap.dev/spec, without compression and check sums.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/types.hpp"
#include "foxglove/channel.hpp"

namespace cornerd::foxglove {

/// Writes in chunks with an index, so that a reader can start anywhere. Messages may come in any
/// order.
class McapWriter {
 public:
  using Write = std::function<void(std::string_view bytes)>;

  /// `write` may throw; the writer is then of no more use.
  explicit McapWriter(Write write);

  void add(ChannelId channel, core::TimeNs t_ns, std::string_view json);
  /// The rest and the index. Nothing may be added after it.
  void finish();

  std::uint64_t messages() const;

 private:
  static constexpr std::size_t kIds = 9;
  /// Messages of one channel in the open chunk: time, and offset in it.
  using Index = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
  struct TimeSpan {
    std::uint64_t first = UINT64_MAX;
    std::uint64_t last = 0;
    void add(std::uint64_t t) {
      first = t < first ? t : first;
      last = t > last ? t : last;
    }
    std::uint64_t begin() const { return first > last ? 0 : first; }
  };

  void put(std::string_view bytes);
  void close_chunk();

  Write write_;
  std::uint64_t position_ = 0;
  std::string chunk_;
  TimeSpan chunk_span_;
  TimeSpan span_;
  std::array<Index, kIds> indices_;
  std::array<std::uint64_t, kIds> counts_{};
  std::string chunk_indices_;  ///< records of the summary
  std::uint32_t chunks_ = 0;
};

}  // namespace cornerd::foxglove
