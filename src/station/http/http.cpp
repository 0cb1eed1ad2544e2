#include "station/http/http.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text/json.hpp"

namespace lapwing::station {
namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, lower, lower);
}

std::string_view media_type(std::string_view content_type) {
  auto const type = content_type.substr(0, content_type.find(';'));
  auto const end = type.find_last_not_of(" \t");
  return type.substr(0, end == std::string_view::npos ? 0 : end + 1);
}

std::string_view HttpRequest::header(std::string_view name) const {
  auto const found = std::ranges::find_if(headers, [&](auto const& h) { return equal_ignoring_case(h.name, name); });
  return found == headers.end() ? std::string_view{} : std::string_view{found->value};
}

std::size_t HttpRequest::header_count(std::string_view name) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(headers, [&](auto const& h) { return equal_ignoring_case(h.name, name); }));
}

std::optional<std::string> HttpRequest::parameter(std::string_view name) const {
  std::string_view rest = query;
  while (!rest.empty()) {
    auto const pair = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
    auto const equals = pair.find('=');
    if (pair.substr(0, equals) != name) continue;
    return percent_decoded(equals == std::string_view::npos ? std::string_view{} : pair.substr(equals + 1));
  }
  return std::nullopt;
}

std::optional<std::vector<HttpRequest::Parameter>> HttpRequest::parameters() const {
  std::vector<Parameter> all;
  std::string_view rest = query;
  while (!rest.empty()) {
    auto const pair = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
    if (pair.empty()) continue;
    auto const equals = pair.find('=');
    auto name = percent_decoded(pair.substr(0, equals));
    auto value = percent_decoded(equals == std::string_view::npos ? std::string_view{} : pair.substr(equals + 1));
    if (!name || !value) return std::nullopt;
    all.push_back({*std::move(name), *std::move(value)});
  }
  return all;
}

std::optional<std::string> percent_decoded(std::string_view text) {
  std::string decoded;
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    if (i + 2 >= text.size()) return std::nullopt;
    unsigned char byte = 0;
    char const* const digits = text.data() + i + 1;
    auto const [end, error] = std::from_chars(digits, digits + 2, byte, 16);
    if (error != std::errc{} || end != digits + 2) return std::nullopt;
    decoded += static_cast<char>(byte);
    i += 2;
  }
  return decoded;
}

std::string percent_encoded(std::string_view text) {
  std::string encoded;
  for (unsigned char const c : text) {
    bool const is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                          c == '.' || c == '_' || c == '~';
    encoded += is_plain ? std::string(1, static_cast<char>(c)) : fmt::format("%{:02X}", c);
  }
  return encoded;
}

std::optional<HttpRequest> request_for(std::string_view method, std::string_view target) {
  auto const question = target.find('?');
  auto path = percent_decoded(target.substr(0, question));
  if (!path || !path->starts_with('/')) return std::nullopt;
  HttpRequest request{.method = std::string(method), .path = std::move(*path)};
  auto rest = target.substr(1, question == std::string_view::npos ? question : question - 1);
  for (bool is_last = false; !is_last;) {
    auto const part = rest.substr(0, rest.find('/'));
    is_last = part.size() == rest.size();
    request.segments.push_back(percent_decoded(part).value_or(""));
    if (!is_last) rest.remove_prefix(part.size() + 1);
  }
  if (question != std::string_view::npos) request.query = target.substr(question + 1);
  return request;
}

std::string_view reason_phrase(int status) {
  switch (status) {
    case 200: return "OK";
    case 201: return "Created";
    case 202: return "Accepted";
    case 204: return "No Content";
    case 304: return "Not Modified";
    case 400: return "Bad Request";
    case 401: return "Unauthorized";
    case 403: return "Forbidden";
    case 404: return "Not Found";
    case 405: return "Method Not Allowed";
    case 409: return "Conflict";
    case 412: return "Precondition Failed";
    case 413: return "Content Too Large";
    case 415: return "Unsupported Media Type";
    case 422: return "Unprocessable Content";
    case 429: return "Too Many Requests";
    case 431: return "Request Header Fields Too Large";
    case 502: return "Bad Gateway";
    case 503: return "Service Unavailable";
    case 504: return "Gateway Timeout";
    case 507: return "Insufficient Storage";
    default: return "Error";
  }
}

HttpResponse problem(int status, std::string_view detail, std::string_view hint) {
  nlohmann::ordered_json body{{"title", reason_phrase(status)}, {"status", status}, {"detail", detail}};
  if (!hint.empty()) body["hint"] = hint;
  return {status, "application/problem+json", base::to_text(body), {}};
}

HttpResponse problem(base::Error const& error) {
  switch (error.kind) {
    case base::ErrorKind::invalid_input: return problem(400, error.message, error.hint);
    case base::ErrorKind::not_found: return problem(404, error.message, error.hint);
    case base::ErrorKind::timed_out: return problem(504, error.message, error.hint);
    default: return problem(409, error.message, error.hint);
  }
}

}  // namespace lapwing::station
