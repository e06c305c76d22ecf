// SPDX-License-Identifier: MIT
#include "foxglove/mcap_writer.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace cornerd::foxglove {

namespace {

constexpr std::string_view kMagic = "\x89MCAP0\r\n";
constexpr std::size_t kChunkBytes = 1024 * 1024;

enum Opcode : std::uint8_t {
  kHeader = 1,
  kFooter = 2,
  kSchema = 3,
  kChannel = 4,
  kMessage = 5,
  kChunk = 6,
  kMessageIndex = 7,
  kChunkIndex = 8,
  kStatistics = 11,
  kDataEnd = 15
};

/// Little-endian numbers and strings, as every field of the format.
class Fields {
 public:
  template <typename T>
  Fields& number(T value) {
    for (std::size_t i = 0; i < sizeof value; ++i) {
      bytes_ += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xff);
    }
    return *this;
  }
  Fields& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  /// With its length in 32 bits.
  Fields& text(std::string_view text) {
    return number(static_cast<std::uint32_t>(text.size())).raw(text);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

void append_record(std::string& out, Opcode opcode, const Fields& fields) {
  out += static_cast<char>(opcode);
  out += Fields().number(static_cast<std::uint64_t>(fields.bytes().size())).bytes();
  out += fields.bytes();
}

std::string record(Opcode opcode, const Fields& fields) {
  std::string out;
  append_record(out, opcode, fields);
  return out;
}

void append_schema(std::string& out, const Channel& channel) {
  append_record(out, kSchema,
                Fields()
                    .number(static_cast<std::uint16_t>(channel.id))
                    .text(channel.schema_name)
                    .text(kSchemaEncoding)
                    .text(channel.schema));
}

void append_channel(std::string& out, const Channel& channel) {
  append_record(out, kChannel,
                Fields()
                    .number(static_cast<std::uint16_t>(channel.id))
                    .number(static_cast<std::uint16_t>(channel.id))
                    .text(channel.topic)
                    .text(kMessageEncoding)
                    .text(""));
}

const Channel& channel_of(ChannelId id) { return channels()[static_cast<std::size_t>(id) - 1]; }

}  // namespace

McapWriter::McapWriter(Write write) : write_(std::move(write)) {
  put(std::string(kMagic) + record(kHeader, Fields().text("").text("cornerctl")));
}

void McapWriter::put(std::string_view bytes) {
  write_(bytes);
  position_ += bytes.size();
}

std::uint64_t McapWriter::messages() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
}

void McapWriter::add(ChannelId channel, core::TimeNs t_ns, std::string_view json) {
  const auto id = static_cast<std::size_t>(channel);
  if (counts_[id] == 0) {
    append_schema(chunk_, channel_of(channel));
    append_channel(chunk_, channel_of(channel));
  }
  const auto time = static_cast<std::uint64_t>(std::max<core::TimeNs>(t_ns, 0));
  indices_[id].emplace_back(time, chunk_.size());
  chunk_span_.add(time);
  span_.add(time);
  append_record(chunk_, kMessage,
                Fields()
                    .number(static_cast<std::uint16_t>(id))
                    .number(static_cast<std::uint32_t>(counts_[id]++))
                    .number(time)
                    .number(time)
                    .raw(json));
  if (chunk_.size() >= kChunkBytes) close_chunk();
}

void McapWriter::close_chunk() {
  if (chunk_.empty()) return;
  const std::uint64_t start = position_;
  const std::uint64_t size = chunk_.size();
  put(record(kChunk, Fields()
                         .number(chunk_span_.begin())
                         .number(chunk_span_.last)
                         .number(size)
                         .number(std::uint32_t{0})
                         .text("")
                         .number(size)
                         .raw(chunk_)));
  const std::uint64_t length = position_ - start;
  Fields offsets;
  for (std::size_t id = 0; id < kIds; ++id) {
    if (indices_[id].empty()) continue;
    offsets.number(static_cast<std::uint16_t>(id)).number(position_);
    Fields entries;
    for (const auto& [time, offset] : indices_[id]) entries.number(time).number(offset);
    put(record(kMessageIndex,
               Fields().number(static_cast<std::uint16_t>(id)).text(entries.bytes())));
    indices_[id].clear();
  }
  append_record(chunk_indices_, kChunkIndex,
                Fields()
                    .number(chunk_span_.begin())
                    .number(chunk_span_.last)
                    .number(start)
                    .number(length)
                    .text(offsets.bytes())
                    .number(position_ - start - length)
                    .text("")
                    .number(size)
                    .number(size));
  ++chunks_;
  chunk_.clear();
  chunk_span_ = {};
}

void McapWriter::finish() {
  close_chunk();
  put(record(kDataEnd, Fields().number(std::uint32_t{0})));
  const std::uint64_t summary_start = position_;
  std::string summary;
  Fields counts;
  std::uint16_t used = 0;
  for (const Channel& channel : channels()) {
    const std::uint64_t count = counts_[static_cast<std::size_t>(channel.id)];
    if (count == 0) continue;
    ++used;
    append_schema(summary, channel);
    append_channel(summary, channel);
    counts.number(static_cast<std::uint16_t>(channel.id)).number(count);
  }
  append_record(summary, kStatistics,
                Fields()
                    .number(messages())
                    .number(used)
                    .number(std::uint32_t{used})
                    .number(std::uint32_t{0})
                    .number(std::uint32_t{0})
                    .number(chunks_)
                    .number(span_.begin())
                    .number(span_.last)
                    .text(counts.bytes()));
  put(summary + chunk_indices_);
  put(record(kFooter,
             Fields().number(summary_start).number(std::uint64_t{0}).number(std::uint32_t{0})));
  put(kMagic);
}

}  // namespace cornerd::foxglove
