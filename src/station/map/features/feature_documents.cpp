#include "station/map/features/feature_documents.hpp"

#include <functional>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/async/pool.hpp"
#include "base/text/utc_text.hpp"
#include "map/features/feature_json.hpp"

namespace lapwing::station {

namespace {

/// All that is needed to write one page, and nothing of the map itself.
struct PageContent {
  std::vector<map::Feature> features = {};
  std::map<std::string, geo::Site, std::less<>> sites = {};
  std::string rest = {};  ///< the members behind the features
};

std::string write_page(PageContent const& content) {
  std::string text = R"({"type":"FeatureCollection","features":[)";
  bool is_first = true;
  for (auto const& feature : content.features) {
    if (!std::exchange(is_first, false)) text += ',';
    text += dump(map::feature_json(feature, content.sites.at(feature.site)));
  }
  return text + "]," + content.rest;
}

base::Task<HttpResponse> write(base::Loop& loop, PageContent content) {
  auto text = co_await loop.on_pool(write_page, std::move(content));
  co_return HttpResponse{.content_type = std::string(geojson_type), .body = std::move(text)};
}

}  // namespace

Json links_json(std::vector<Link> const& links) {
  Json list = Json::array();
  for (auto const& link : links) {
    Json json{{"href", link.href}, {"rel", link.rel}, {"type", link.type}};
    if (!link.title.empty()) json["title"] = link.title;
    list.push_back(std::move(json));
  }
  return list;
}

std::string origin_of(HttpRequest const& request) {
  // Nobody gains by a false word here: whoever sends it is the only one who gets the links.
  bool const is_secure = equal_ignoring_case(request.header("X-Forwarded-Proto"), "https");
  return fmt::format("{}://{}", is_secure ? "https" : "http", request.header("Host"));
}

std::string address_of(HttpRequest const& request) {
  auto address = origin_of(request);
  for (auto const& segment : request.segments) address += fmt::format("/{}", percent_encoded(segment));
  return request.query.empty() ? address : fmt::format("{}?{}", address, request.query);
}

std::string address_at(HttpRequest const& request, std::size_t offset) {
  auto other = request;
  other.query.clear();
  for (auto const& [name, value] : request.parameters().value_or(std::vector<HttpRequest::Parameter>{})) {
    if (name == "offset") continue;
    other.query +=
        fmt::format("{}{}={}", other.query.empty() ? "" : "&", percent_encoded(name), percent_encoded(value));
  }
  if (offset > 0) other.query += fmt::format("{}offset={}", other.query.empty() ? "" : "&", offset);
  return address_of(other);
}

std::string feature_tag(map::LiveMap const& map, map::FeatureRecord const& record) {
  auto const* const site = map.site(record.feature.site);
  // A site that moves takes its features along; their revisions stay.
  std::hash<double> const hash;
  auto const anchor = site ? hash(site->anchor().lat_rad) ^ (hash(site->anchor().lon_rad) << 1U) : 0;
  return fmt::format("\"{}-{:x}\"", record.revision, anchor);
}

Reply feature_collection(base::Loop& loop, map::LiveMap const& map, HttpRequest const& request,
                         FeatureQuery const& query, std::vector<Link> links) {
  auto const page = find_features(map, query);
  PageContent content{.sites = map.sites()};
  for (auto const* record : page.records) content.features.push_back(record->feature);
  auto const reached = query.offset + page.records.size();
  links.insert(links.begin(), {"self", address_of(request), geojson_type});
  if (reached < page.matched) links.push_back({"next", address_at(request, reached), geojson_type});
  if (query.offset > 0)
    links.push_back({"prev", address_at(request, query.offset - std::min(query.offset, query.limit)), geojson_type});
  auto rest = dump({{"links", links_json(links)},
                    {"timeStamp", base::utc_text(loop.utc_now())},
                    {"numberMatched", page.matched},
                    {"numberReturned", page.records.size()}});
  content.rest = rest.substr(1);
  return write(loop, std::move(content));
}

}  // namespace lapwing::station
