#include "station/http/internal/beast_messages.hpp"

#include <string_view>
#include <utility>

#include <boost/beast/http/error.hpp>

namespace lapwing::station::internal {

namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;

namespace {

/// What a page from this server may load. Map tiles may come from anywhere the operator names, over TLS or from this
/// machine; MapLibre runs its worker from a blob.
constexpr std::string_view content_security_policy =
    "default-src 'self'; script-src 'self'; style-src 'self'; worker-src 'self' blob:; child-src blob:; "
    "img-src 'self' data: blob: https: http://127.0.0.1:* http://localhost:*; "
    "connect-src 'self' https: http://127.0.0.1:* http://localhost:*; "
    "object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

}  // namespace

std::optional<HttpRequest> plain(http::request<http::string_body> const& request) {
  auto const target = request.target();
  auto const method = request.method_string();
  auto result = request_for({method.data(), method.size()}, {target.data(), target.size()});
  if (!result) return std::nullopt;
  for (auto const& field : request) {
    result->headers.push_back({std::string(field.name_string()), std::string(field.value())});
  }
  return result;
}

http::response<http::string_body> wire(HttpResponse response, bool is_head, bool keep_alive) {
  http::response<http::string_body> result;
  result.result(static_cast<unsigned>(response.status));
  result.set(http::field::server, "lapwing");
  result.set("Content-Security-Policy",
             beast::string_view(content_security_policy.data(), content_security_policy.size()));
  result.set("X-Content-Type-Options", "nosniff");
  result.set("Referrer-Policy", "no-referrer");
  result.set("Permissions-Policy",
             "accelerometer=(), camera=(), display-capture=(), geolocation=(), gyroscope=(), magnetometer=(), "
             "microphone=(), midi=(), payment=(), serial=(), usb=()");
  result.set("Cross-Origin-Opener-Policy", "same-origin");
  result.set("Cross-Origin-Resource-Policy", "same-origin");
  result.set(http::field::cache_control, "no-store");
  if (!response.content_type.empty()) result.set(http::field::content_type, response.content_type);
  for (auto const& header : response.headers) result.set(header.name, header.value);
  result.keep_alive(keep_alive);
  auto const length = response.body.size();
  if (!is_head) result.body() = std::move(response.body);
  if (response.status != 304) result.content_length(length);
  return result;
}

int status_of(error_code error) {
  if (error == http::error::header_limit) return 431;
  if (error == http::error::body_limit) return 413;
  return 400;
}

bool is_malformed(error_code error) {
  return error.category() == make_error_code(http::error::bad_method).category() &&
         error != http::error::end_of_stream && error != http::error::partial_message;
}

}  // namespace lapwing::station::internal
