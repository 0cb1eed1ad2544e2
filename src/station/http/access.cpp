#include "station/http/access.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/text/constant_time.hpp"

namespace lapwing::station {
namespace {

/// "localhost:8080" and "[::1]:8080" without the port and brackets.
std::string_view host_name(std::string_view host) {
  if (host.starts_with('[')) {
    auto const end = host.find(']');
    return end == std::string_view::npos ? std::string_view{} : host.substr(1, end - 1);
  }
  return host.substr(0, host.find(':'));
}

/// An address cannot be rebound by DNS, so it is as good as its route to us.
bool is_address(std::string_view name) {
  bool const v6 = name.contains(':');
  auto const is_digit = [&](unsigned char c) {
    return v6 ? std::isxdigit(c) || c == ':' || c == '.' : std::isdigit(c) || c == '.';
  };
  return !name.empty() && std::ranges::all_of(name, is_digit);
}

bool is_known_host(AccessPolicy const& policy, std::string_view host) {
  auto const name = host_name(host);
  if (is_loopback_name(name)) return true;
  if (!policy.loopback_only && is_address(name)) return true;
  return std::ranges::any_of(policy.host_names, [&](auto const& known) { return equal_ignoring_case(known, name); });
}

/// Browsers send the page's own origin: it must be this very server. Programs send none.
bool is_own_origin(std::string_view origin, std::string_view host) {
  for (std::string_view const scheme : {"http://", "https://"}) {
    if (origin.starts_with(scheme)) return equal_ignoring_case(origin.substr(scheme.size()), host);
  }
  return false;
}

/// What another site's page cannot send unasked: browsers ask first for any type but those of forms. (Fetch standard,
/// "CORS-safelisted request-header".) A DELETE has no body, and browsers ask before each.
bool asks_first(HttpRequest const& request) {
  if (request.method == "DELETE" && request.header("Content-Type").empty()) return true;
  constexpr std::array<std::string_view, 6> known = {
      "application/json", "application/geo+json", "application/sdp", "image/jpeg", "image/png", "image/webp"};
  auto const type = media_type(request.header("Content-Type"));
  return std::ranges::any_of(known, [&](auto one) { return equal_ignoring_case(type, one); });
}

bool is_guarded(std::string_view path) {
  return path.starts_with("/api/") || path == "/metrics" || path == "/ogc" || path.starts_with("/ogc/");
}

bool carries_token(AccessPolicy const& policy, HttpRequest const& request) {
  constexpr std::string_view bearer = "Bearer ";
  auto const authorization = request.header("Authorization");
  if (authorization.size() > bearer.size() && equal_ignoring_case(authorization.substr(0, bearer.size()), bearer)) {
    return base::equal_in_constant_time(authorization.substr(bearer.size()), policy.token);
  }
  // Browsers cannot set headers on a WebSocket. Addresses end up in histories: nowhere else.
  auto const parameter = request.opens_websocket ? request.parameter("token") : std::nullopt;
  return parameter && base::equal_in_constant_time(*parameter, policy.token);
}

}  // namespace

bool is_loopback_name(std::string_view host) {
  return equal_ignoring_case(host, "localhost") || host == "::1" || (host.starts_with("127.") && is_address(host));
}

bool is_trusted(AccessPolicy const& policy, HttpRequest const& request) {
  return policy.token.empty() || carries_token(policy, request);
}

std::optional<HttpResponse> refusal(AccessPolicy const& policy, HttpRequest const& request) {
  if (request.header_count("Host") > 1) {
    return problem(400, "The request has several Host headers.");  // each reader may believe another one
  }
  auto const host = request.header("Host");
  if (!is_known_host(policy, host)) {
    return problem(403, "This station is not known by the name in the Host header.",
                   "Use http://127.0.0.1 or add the name to the station's host names.");
  }
  bool const is_upgrade = equal_ignoring_case(request.header("Upgrade"), "websocket");
  bool const changes_state = request.method != "GET" && request.method != "HEAD";
  auto const origin = request.header("Origin");
  if ((is_upgrade || changes_state) && !origin.empty() && !is_own_origin(origin, host)) {
    return problem(403, "Another web site's page may not use this station.");
  }
  if (changes_state && !asks_first(request)) {
    return problem(415, "A request that changes something must be JSON, or a picture.",
                   "Send Content-Type: application/json.");
  }
  if (!policy.token.empty() && is_guarded(request.path) && !carries_token(policy, request)) {
    auto response = problem(401, "This station asks for its token.", "Send Authorization: Bearer TOKEN.");
    response.headers.push_back({"WWW-Authenticate", "Bearer"});
    return response;
  }
  return std::nullopt;
}

}  // namespace lapwing::station
