#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "base/async/task.hpp"
#include "station/http/http.hpp"

namespace lapwing::station {

/// The answer, or the work that ends in it: what vehicles are asked for takes its time. The work outlives the request.
using Reply = std::variant<HttpResponse, base::Task<HttpResponse>>;

/// Which function answers which method on which path.
class Router {
 public:
  using Handler = std::function<Reply(HttpRequest const&)>;
  struct Route {
    std::string method;
    std::string path;
    Handler handler;
  };

  void add(std::string method, std::string path, Handler handler);
  [[nodiscard]] std::vector<Route> const& routes() const { return routes_; }
  [[nodiscard]] bool knows(std::string_view path) const;
  /// The handler's answer; HEAD is answered as GET (the server leaves out the body); 404, or 405 with `Allow`.
  [[nodiscard]] Reply answer(HttpRequest const& request) const;

 private:
  std::vector<Route> routes_;
};

}  // namespace lapwing::station
