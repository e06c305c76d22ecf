// SPDX-License-Identifier: MIT
// Requests and responses, apart from any HTTP library.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace cornerd::web {

struct Request {
  std::string method;
  std::string path;   ///< percent-decoded, without the query
  std::string query;  ///< as received, without the question mark
  std::string host;   ///< the header's value; empty if absent
  std::string origin;
  std::string content_type;
  std::string authorization;
  std::string body;
  bool from_loopback = false;  ///< the client's address
};

struct Response {
  unsigned status = 200;
  std::string content_type = "application/json";
  std::string body = {};
  std::string download_name = {};  ///< for the browser's file dialog; empty: none
  /// Of what is limited in number; given back when the response is written.
  std::shared_ptr<const void> place = {};
};

/// {"class":"ERROR","code":...,"message":...}, as the daemon words its own.
Response error_response(unsigned status, std::string_view code, std::string_view message);

/// Fills path and query from a request target. False if it is no absolute path or an escape is bad.
bool set_target(std::string_view target, Request& request);

/// The percent-decoded value of a query's parameter; empty if absent or badly escaped.
std::string query_value(std::string_view query, std::string_view name);

}  // namespace cornerd::web
