// SPDX-License-Identifier: MIT
// Any bytes give a request or an error, and the answer to either is one line of JSON.
#include "message/request.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "message/line_writer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd::message;
  static LineWriter writer;
  const Request request = parse_request({reinterpret_cast<const char*>(data), size});
  const auto* error = std::get_if<RequestError>(&request.body);
  const std::string_view answer =
      error != nullptr ? writer.error(error->code, error->text, request.name, request.id_json)
                       : writer.ok(request.name, request.id_json);
  if (!nlohmann::json::accept(answer) || answer.find('\n') != answer.size() - 1) std::abort();
  return 0;
}
