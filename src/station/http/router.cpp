#include "station/http/router.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/assert.hpp"

namespace lapwing::station {

namespace {

/// "{y}.png" against "7.png"; nothing where it does not fit. A name takes at least one character.
bool fits_part(std::string_view pattern, std::string const& part, PathArguments& arguments) {
  auto const begin = pattern.find('{');
  if (begin == std::string_view::npos) return pattern == part;
  auto const end = pattern.find('}', begin);
  auto const before = pattern.substr(0, begin);
  auto const behind = pattern.substr(end + 1);
  if (part.size() <= before.size() + behind.size() || !part.starts_with(before) || !part.ends_with(behind))
    return false;
  arguments.add(std::string(pattern.substr(begin + 1, end - begin - 1)),
                part.substr(before.size(), part.size() - before.size() - behind.size()));
  return true;
}

/// What stands for the names of the route; nothing where the request's path is another.
std::optional<PathArguments> arguments_of(Router::Route const& route, HttpRequest const& request) {
  PathArguments arguments;
  if (!route.path.contains('{')) {
    if (route.path != request.path) return std::nullopt;
    return arguments;
  }
  std::string_view rest = std::string_view(route.path).substr(1);
  for (std::size_t i = 0; i < request.segments.size(); ++i) {
    auto const pattern = rest.substr(0, rest.find('/'));
    bool const is_last = pattern.size() == rest.size();
    if (is_last != (i + 1 == request.segments.size())) return std::nullopt;
    if (!fits_part(pattern, request.segments[i], arguments)) return std::nullopt;
    if (is_last) return arguments;
    rest.remove_prefix(pattern.size() + 1);
  }
  return std::nullopt;
}

bool has_method(Router::Route const& route, HttpRequest const& request) {
  return route.method == (request.method == "HEAD" ? "GET" : std::string_view(request.method));
}

}  // namespace

std::string const& PathArguments::operator[](std::string_view name) const {
  auto const found = std::ranges::find(values_, name, &std::pair<std::string, std::string>::first);
  LAPWING_ASSERT(found != values_.end(), name);
  return found->second;
}

void Router::add(std::string method, std::string path, Handler handler) {
  add(std::move(method), std::move(path),
      [handler = std::move(handler)](HttpRequest const& request, PathArguments const&) { return handler(request); });
}

void Router::add(std::string method, std::string path, HandlerWithArguments handler,
                 std::optional<std::size_t> max_body_bytes) {
  routes_.push_back({std::move(method), std::move(path), std::move(handler), max_body_bytes});
}

bool Router::knows(HttpRequest const& request) const {
  return std::ranges::any_of(routes_, [&](auto const& route) { return arguments_of(route, request).has_value(); });
}

std::optional<std::size_t> Router::max_body_bytes(HttpRequest const& request) const {
  auto const found = std::ranges::find_if(
      routes_, [&](auto const& route) { return has_method(route, request) && arguments_of(route, request); });
  return found == routes_.end() ? std::nullopt : found->max_body_bytes;
}

std::size_t Router::largest_body_bytes() const {
  std::size_t largest = 0;
  for (auto const& route : routes_) largest = std::max(largest, route.max_body_bytes.value_or(0));
  return largest;
}

Reply Router::answer(HttpRequest const& request) const {
  std::string allowed;
  for (auto const& route : routes_) {
    auto const arguments = arguments_of(route, request);
    if (!arguments) continue;
    if (has_method(route, request)) return route.handler(request, *arguments);
    if (!allowed.empty()) allowed += ", ";
    allowed += route.method == "GET" ? "GET, HEAD" : route.method;
  }
  if (allowed.empty()) return problem(404, fmt::format("There is nothing at {}.", request.path));
  auto response =
      problem(405, fmt::format("{} does not work on {}.", request.method, request.path), "Allowed: " + allowed + ".");
  response.headers.push_back({"Allow", allowed});
  return response;
}

}  // namespace lapwing::station
