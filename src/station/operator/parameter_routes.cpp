#include "station/operator/parameter_routes.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/format.h>

#include "base/text/utc_text.hpp"
#include "station/messages/client_request.hpp"
#include "station/messages/feed_json.hpp"
#include "station/messages/request_reader.hpp"

namespace lapwing::station {

using vehicle::VehicleId;
using vehicle::VehicleParameters;

namespace {

/// A number as the vehicle holds it: 0.1, not the double that is nearest to that float.
Json number(vehicle::Parameter const& parameter) {
  if (parameter.type != "real32") return parameter.value;
  return base::json_number<Json>(base::shortest(static_cast<float>(parameter.value)));
}

Json to_json(vehicle::Parameter const& parameter) {
  return {{"name", parameter.name}, {"value", number(parameter)}, {"type", parameter.type}};
}

std::string list_body(VehicleId const& id, vehicle::ParameterList const& list) {
  Json all = Json::array();
  for (auto const& parameter : list.parameters) all.push_back(to_json(parameter));
  return dump({{"vehicle", id.text},
               {"confirmed", to_string(list.confirmed)},
               {"taken", base::to_iso8601(list.taken)},
               {"parameters", std::move(all)}});
}

std::string progress_body(VehicleId const& id, std::optional<vehicle::ParameterProgress> progress) {
  Json json{{"vehicle", id.text}, {"fetching", progress.has_value()}};
  if (progress) json.update({{"done", progress->done}, {"total", progress->total}});
  return dump(json);
}

/// "vehicle-north-1.params" of "north/1".
std::string file_name(VehicleId const& id) {
  auto name = id.text;
  std::ranges::replace_if(name, [](unsigned char c) { return !std::isalnum(c); }, '-');
  return fmt::format("vehicle-{}.params", name);
}

// ---- the work ----

base::Task<HttpResponse> get_all(VehicleParameters& parameters, VehicleId id, bool old_ones_do) {
  auto const list = co_await parameters.all(id, old_ones_do);
  if (!list) co_return problem(list.error());
  co_return HttpResponse{.body = list_body(id, *list)};
}

base::Task<HttpResponse> get_file(VehicleParameters& parameters, VehicleId id, bool old_ones_do) {
  auto text = co_await parameters.file(id, old_ones_do);
  if (!text) co_return problem(text.error());
  HttpResponse response{.content_type = "text/plain; charset=utf-8", .body = *std::move(text)};
  response.headers.push_back({"Content-Disposition", fmt::format("attachment; filename=\"{}\"", file_name(id))});
  co_return response;
}

base::Task<HttpResponse> get_one(VehicleParameters& parameters, VehicleId id, std::string name) {
  auto const value = co_await parameters.read(id, name);
  if (!value) co_return problem(value.error());
  auto json = to_json(*value);
  json["vehicle"] = id.text;
  co_return HttpResponse{.body = dump(json)};
}

base::Task<HttpResponse> put_one(VehicleParameters& parameters, VehicleId id, std::string name, double value,
                                 vehicle::Commander by) {
  auto const change = co_await parameters.change(id, name, value, by);
  if (!change) co_return problem(change.error());
  auto json = to_json(change->after);
  json["vehicle"] = id.text;
  json["before"] = number(change->before);
  co_return HttpResponse{.body = dump(json)};
}

// ---- the requests ----

std::unexpected<base::Error> wrong(std::string message) {
  return base::fail(base::ErrorKind::invalid_input, std::move(message), "See docs/reference/openapi.yaml.");
}

struct Which {
  VehicleId vehicle;
  std::string name = {};  ///< of one parameter
  bool old_ones_do = false;
};

base::Result<Which> which(HttpRequest const& request, bool is_one) {
  auto id = request.parameter("vehicle");
  if (!id || id->empty()) return wrong("The parameter \"vehicle\" of the address, a vehicle's id, is missing.");
  auto name = request.parameter("name").value_or("");
  if (is_one && name.empty()) return wrong("The parameter \"name\" of the address, a vehicle parameter, is missing.");
  auto const cached = request.parameter("cached").value_or("false");
  if (cached != "true" && cached != "false") return wrong("\"cached\" must be true or false.");
  return Which{{*std::move(id)}, std::move(name), cached == "true"};
}

Reply begin_change(VehicleParameters& parameters, Which of, std::string_view body) {
  internal::RequestReader request(body);
  auto const value = request.number("value");
  if (!value) request.refuse("\"value\", the number that the parameter is to have, is missing.");
  auto by = request.result(request.operator_name());
  if (!by) return problem(by.error());
  if (by->empty()) *by = unnamed_client;
  return put_one(parameters, std::move(of.vehicle), std::move(of.name), *value, *std::move(by));
}

}  // namespace

void add_parameter_routes(Router& router, VehicleParameters* parameters) {
  auto const add = [&router, parameters](std::string method, std::string path, bool is_one, auto answer) {
    router.add(std::move(method), std::move(path), [parameters, is_one, answer](HttpRequest const& request) -> Reply {
      if (!parameters) return problem(409, "These vehicles have no parameters.", "They are a recording.");
      auto of = which(request, is_one);
      if (!of) return problem(of.error());
      return answer(*parameters, *std::move(of), request);
    });
  };
  using Of = HttpRequest const&;
  add("GET", "/api/v1/parameters", false, [](VehicleParameters& from, Which of, Of) -> Reply {
    return get_all(from, std::move(of.vehicle), of.old_ones_do);
  });
  add("GET", "/api/v1/parameters/progress", false, [](VehicleParameters& from, Which const& of, Of) -> Reply {
    return HttpResponse{.body = progress_body(of.vehicle, from.progress(of.vehicle))};
  });
  add("GET", "/api/v1/parameters/file", false, [](VehicleParameters& from, Which of, Of) -> Reply {
    return get_file(from, std::move(of.vehicle), of.old_ones_do);
  });
  add("GET", "/api/v1/parameters/value", true, [](VehicleParameters& from, Which of, Of) -> Reply {
    return get_one(from, std::move(of.vehicle), std::move(of.name));
  });
  add("PUT", "/api/v1/parameters/value", true, [](VehicleParameters& from, Which of, Of request) -> Reply {
    return begin_change(from, std::move(of), request.body);
  });
}

}  // namespace lapwing::station
