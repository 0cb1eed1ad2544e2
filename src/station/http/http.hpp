#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

/// HTTP requests and responses as plain values, so that everything but the socket work can be tested without one.
namespace lapwing::station {

struct HttpHeader {
  std::string name;
  std::string value;
};

struct HttpRequest {
  std::string method = {};  ///< upper case, "GET"
  std::string path = {};    ///< percent-decoded, begins with '/'
  /// The path between its slashes, each part decoded by itself: an id that holds a slash stays whole.
  std::vector<std::string> segments = {};
  std::string query = {};  ///< what follows '?', not decoded
  std::vector<HttpHeader> headers = {};
  std::string body = {};
  bool opens_websocket = false;  ///< a whole upgrade of the server's WebSocket endpoint

  /// Value of the first header of that name (in any case); empty when there is none.
  [[nodiscard]] std::string_view header(std::string_view name) const;
  [[nodiscard]] std::size_t header_count(std::string_view name) const;
  /// Decoded value of a query parameter; nothing when it is absent or badly encoded.
  [[nodiscard]] std::optional<std::string> parameter(std::string_view name) const;
  struct Parameter {
    std::string name;
    std::string value;
  };
  /// All query parameters, decoded, in their order; nothing when one is badly encoded.
  [[nodiscard]] std::optional<std::vector<Parameter>> parameters() const;
};

struct HttpResponse {
  int status = 200;
  std::string content_type = "application/json";
  std::string body = {};
  std::vector<HttpHeader> headers = {};
};

/// An error for people and programs: `application/problem+json` (RFC 9457) with `title`, `status`, `detail` and `hint`.
[[nodiscard]] HttpResponse problem(int status, std::string_view detail, std::string_view hint = {});
/// The same with the status that fits the error's kind; 409 for what the vehicle, or whoever commands it, says no to.
[[nodiscard]] HttpResponse problem(base::Error const& error);
/// The standard phrase of a status: 404 is "Not Found".
[[nodiscard]] std::string_view reason_phrase(int status);

/// The request without headers and body; nothing when its target ("/path?query") is badly encoded or no path.
[[nodiscard]] std::optional<HttpRequest> request_for(std::string_view method, std::string_view target);

/// `text` with every %XX replaced; nothing when an escape is cut short or is no hexadecimal number.
[[nodiscard]] std::optional<std::string> percent_decoded(std::string_view text);
/// As one part of an address.
[[nodiscard]] std::string percent_encoded(std::string_view text);
/// "image/png" of "image/png ; charset=x", as it was written.
[[nodiscard]] std::string_view media_type(std::string_view content_type);
/// Letters of ASCII compare equal in either case, as header names and host names do.
[[nodiscard]] bool equal_ignoring_case(std::string_view a, std::string_view b);

}  // namespace lapwing::station
