// SPDX-License-Identifier: MIT
// Request target, host, origin and token, as a browser or an attacker sends them.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "web/access.hpp"
#include "web/router.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd::web;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static const Hub hub;
  static const Router router(
      {.own_name = "robot", .token = "0123456789abcdef", .allowed_origins = {}}, "", "", hub);
  Request request;
  const std::size_t line = text.find('\n');
  request.method = size % 2 == 0 ? "GET" : "POST";
  request.host = line == std::string_view::npos ? "localhost" : text.substr(line + 1);
  request.authorization = request.origin = request.content_type = request.host;
  if (set_target(text.substr(0, line), request)) router.decide(request);
  classes_from(query_value(request.query, "classes"));
  return 0;
}
