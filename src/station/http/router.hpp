#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/async/task.hpp"
#include "station/http/http.hpp"

namespace lapwing::station {

/// The answer, or the work that ends in it: what vehicles are asked for takes its time. The work outlives the request.
using Reply = std::variant<HttpResponse, base::Task<HttpResponse>>;

/// What stands in a request's path where the route has names: "slots" for {layer}.
class PathArguments {
 public:
  void add(std::string name, std::string value) { values_.emplace_back(std::move(name), std::move(value)); }
  /// Precondition: the route has that name.
  [[nodiscard]] std::string const& operator[](std::string_view name) const;

 private:
  std::vector<std::pair<std::string, std::string>> values_;
};

/// Which function answers which method on which path.
class Router {
 public:
  using Handler = std::function<Reply(HttpRequest const&)>;
  using HandlerWithArguments = std::function<Reply(HttpRequest const&, PathArguments const&)>;
  struct Route {
    std::string method;
    std::string path;  ///< a part may be or hold one name in braces: "/api/v1/layers/{layer}/features/{id}"
    HandlerWithArguments handler;
    std::optional<std::size_t> max_body_bytes = {};  ///< instead of the server's
  };

  void add(std::string method, std::string path, Handler handler);
  void add(std::string method, std::string path, HandlerWithArguments handler,
           std::optional<std::size_t> max_body_bytes = {});
  [[nodiscard]] std::vector<Route> const& routes() const { return routes_; }
  [[nodiscard]] bool knows(HttpRequest const& request) const;
  /// How long the body of this request may be, where its route says so.
  [[nodiscard]] std::optional<std::size_t> max_body_bytes(HttpRequest const& request) const;
  /// Of all routes; 0 when none says anything.
  [[nodiscard]] std::size_t largest_body_bytes() const;
  /// The handler's answer; HEAD is answered as GET (the server leaves out the body); 404, or 405 with `Allow`. Of
  /// several routes that fit, the first counts.
  [[nodiscard]] Reply answer(HttpRequest const& request) const;

 private:
  std::vector<Route> routes_;
};

}  // namespace lapwing::station
