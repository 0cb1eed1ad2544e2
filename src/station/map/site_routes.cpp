#include "station/map/site_routes.hpp"

#include <fmt/format.h>

#include "station/map/site_json.hpp"

namespace lapwing::station {

namespace {

HttpResponse put_site(map::LiveMap& map, std::string const& id, std::string_view body) {
  auto site = parse_site(id, body);
  if (!site) return problem(site.error());
  bool const is_new = !map.site(id);
  if (is_new && map.sites().size() >= most_sites)
    return problem(409, fmt::format("The map has {} sites already.", most_sites));
  map.put_site(*std::move(site));
  return {.status = is_new ? 201 : 200, .body = site_body(*map.site(id))};
}

}  // namespace

void add_site_routes(Router& router, map::LiveMap& map) {
  router.add("GET", "/api/v1/sites", [&map](HttpRequest const&) { return HttpResponse{.body = sites_message(map)}; });
  router.add("GET", "/api/v1/sites/{id}", [&map](HttpRequest const&, PathArguments const& arguments) -> Reply {
    auto const* const site = map.site(arguments["id"]);
    if (!site) return problem(404, fmt::format("There is no site \"{}\".", arguments["id"]));
    return HttpResponse{.body = site_body(*site)};
  });
  router.add("PUT", "/api/v1/sites/{id}", [&map](HttpRequest const& request, PathArguments const& arguments) {
    return put_site(map, arguments["id"], request.body);
  });
}

}  // namespace lapwing::station
