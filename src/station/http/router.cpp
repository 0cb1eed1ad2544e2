#include "station/http/router.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace lapwing::station {

void Router::add(std::string method, std::string path, Handler handler) {
  routes_.push_back({std::move(method), std::move(path), std::move(handler)});
}

bool Router::knows(std::string_view path) const {
  return std::ranges::any_of(routes_, [&](auto const& route) { return route.path == path; });
}

Reply Router::answer(HttpRequest const& request) const {
  std::string_view const method = request.method == "HEAD" ? "GET" : std::string_view(request.method);
  std::string allowed;
  for (auto const& route : routes_) {
    if (route.path != request.path) continue;
    if (route.method == method) return route.handler(request);
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
