// SPDX-License-Identifier: MIT
// Writes compact JSON into preallocated memory.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/types.hpp"

namespace cornerd::message {

/// Decimal places of seconds, and of values without a unit.
inline constexpr int kTimeDecimals = 6;

/// Inserts commas itself. Allocates only if the text outgrows `capacity` bytes.
class JsonText {
 public:
  explicit JsonText(std::size_t capacity) { text_.reserve(capacity); }

  void clear() { text_.clear(); }
  std::string_view view() const { return text_; }

  void open_object() { open('{'); }
  void close_object() { text_ += '}'; }
  void open_array() { open('['); }
  void close_array() { text_ += ']'; }
  void end_line() { text_ += '\n'; }

  void key(std::string_view name);

  /// Quoted and escaped; bytes that are not UTF-8 become U+FFFD.
  void string(std::string_view value);
  /// `json`: valid JSON.
  void raw(std::string_view json);
  void boolean(bool value) { raw(value ? "true" : "false"); }
  template <typename T>
  void integer(T value) {
    separate();
    if constexpr (std::is_signed_v<T>) {
      append_integer(static_cast<std::int64_t>(value));
    } else {
      append_integer(static_cast<std::uint64_t>(value));
    }
  }
  /// At most `decimals` (<= 9) decimal places, without trailing zeros. Finite values only.
  void fixed(double value, int decimals);
  /// Six significant digits. Finite values only.
  void significant(double value);
  /// The fewest digits that read back as the same double. Finite values only.
  void shortest(double value);
  /// An angle in (-pi, pi], to 1e-6 rad. Near the ends it is rounded towards zero, so that the
  /// value read back is in the interval too.
  void angle(double value_rad);
  /// Seconds with six decimal places, the resolution of UNIX time in a double.
  void seconds(core::TimeNs t_ns);
  void hex(std::span<const std::uint8_t> bytes);

  // A key and its value.
  void string(std::string_view name, std::string_view value) { key(name), string(value); }
  void raw(std::string_view name, std::string_view json) { key(name), raw(json); }
  void boolean(std::string_view name, bool value) { key(name), boolean(value); }
  template <typename T>
  void integer(std::string_view name, T value) {
    key(name), integer(value);
  }
  void seconds(std::string_view name, core::TimeNs t_ns) { key(name), seconds(t_ns); }
  void open_object(std::string_view name) { key(name), open_object(); }
  void open_array(std::string_view name) { key(name), open_array(); }
  // Written only if not empty, or finite.
  void text(std::string_view name, std::string_view value) {
    if (!value.empty()) string(name, value);
  }
  void number(std::string_view name, double value, int decimals);
  void significant(std::string_view name, double value) {
    if (std::isfinite(value)) key(name), significant(value);
  }

 private:
  void open(char bracket) {
    separate();
    text_ += bracket;
  }
  void separate();
  void append_integer(std::int64_t value);
  void append_integer(std::uint64_t value);
  void append_scaled(std::int64_t scaled, int decimals, bool keep_zeros);

  std::string text_;
};

/// Length in bytes of the UTF-8 character at the start of `text` (RFC 3629); 0 if there is none.
std::size_t utf8_length(std::string_view text);

}  // namespace cornerd::message
