// SPDX-License-Identifier: MIT
// Frames of a Foxglove client: text, and binary after an advertised channel.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "web/foxglove_session.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using cornerd::web::FoxgloveSession;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  cornerd::web::foxglove_protocol(bytes);
  FoxgloveSession session(/*may_publish=*/true);
  session.on_text(
      R"({"op":"advertise","channels":[{"id":1,"topic":"/initialpose","encoding":"json"}]})");
  session.on_text(bytes);
  session.on_binary(bytes);
  session.on_line(bytes, 0);
  while (session.has_frame()) session.take_frame();
  return 0;
}
