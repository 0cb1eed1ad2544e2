#pragma once

#include <functional>
#include <string>
#include <vector>

#include "station/http.hpp"

namespace lapwing::station {

/// Which function answers which method on which path.
class Router {
 public:
  using Handler = std::function<HttpResponse(HttpRequest const&)>;
  struct Route {
    std::string method;
    std::string path;
    Handler handler;
  };

  void add(std::string method, std::string path, Handler handler);
  [[nodiscard]] std::vector<Route> const& routes() const { return routes_; }
  [[nodiscard]] bool knows(std::string_view path) const;
  /// The handler's answer; HEAD is answered as GET (the server leaves out the body); 404, or 405 with `Allow`.
  [[nodiscard]] HttpResponse answer(HttpRequest const& request) const;

 private:
  std::vector<Route> routes_;
};

}  // namespace lapwing::station
