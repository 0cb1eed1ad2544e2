#include "station/http/access.hpp"

#include <algorithm>
#include <cctype>

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
  bool const v6 = name.find(':') != std::string_view::npos;
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

bool is_json(std::string_view content_type) {
  auto const media_type = content_type.substr(0, content_type.find(';'));
  auto const end = media_type.find_last_not_of(" \t");
  return equal_ignoring_case(media_type.substr(0, end == std::string_view::npos ? 0 : end + 1), "application/json");
}

/// Takes as long for a nearly right token as for a wrong one: as long as `given` is, whatever `token` is.
bool equal_in_constant_time(std::string_view given, std::string_view token) {
  bool const same_length = given.size() == token.size();
  auto const against = same_length ? token : given;
  unsigned char difference = same_length ? 0 : 1;
  for (std::size_t i = 0; i < given.size(); ++i) difference |= static_cast<unsigned char>(given[i] ^ against[i]);
  return difference == 0;
}

bool carries_token(AccessPolicy const& policy, HttpRequest const& request) {
  constexpr std::string_view bearer = "Bearer ";
  auto const authorization = request.header("Authorization");
  if (authorization.size() > bearer.size() && equal_ignoring_case(authorization.substr(0, bearer.size()), bearer)) {
    return equal_in_constant_time(authorization.substr(bearer.size()), policy.token);
  }
  // Browsers cannot set headers on a WebSocket. Addresses end up in histories: nowhere else.
  auto const parameter = request.opens_websocket ? request.parameter("token") : std::nullopt;
  return parameter && equal_in_constant_time(*parameter, policy.token);
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
  if (changes_state && !is_json(request.header("Content-Type"))) {
    return problem(415, "A request that changes something must be JSON.", "Send Content-Type: application/json.");
  }
  bool const is_guarded = request.path.starts_with("/api/") || request.path == "/metrics";
  if (!policy.token.empty() && is_guarded && !carries_token(policy, request)) {
    auto response = problem(401, "This station asks for its token.", "Send Authorization: Bearer TOKEN.");
    response.headers.push_back({"WWW-Authenticate", "Bearer"});
    return response;
  }
  return std::nullopt;
}

}  // namespace lapwing::station
