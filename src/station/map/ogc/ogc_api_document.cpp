#include "station/map/ogc/ogc_api_document.hpp"

#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "map/features/properties.hpp"
#include "station/map/features/feature_query.hpp"

namespace lapwing::station {

namespace {

Json parameter(std::string_view name, Json schema, std::string_view description, std::string_view in = "query") {
  Json json{{"name", name}, {"in", in}, {"required", in == "path"}, {"schema", std::move(schema)}};
  if (!description.empty()) json["description"] = description;
  if (in == "query") json["style"] = "form";
  if (in == "query") json["explode"] = false;
  return json;
}

Json schema_of(map::Property const& property) {
  Json schema{{"type", "string"}};
  if (property.kind == map::PropertyKind::boolean) schema["type"] = "boolean";
  if (property.kind == map::PropertyKind::integer) schema["type"] = "integer";
  if (property.kind == map::PropertyKind::real) schema["type"] = "number";
  if (property.kind == map::PropertyKind::time) schema["format"] = "date-time";
  if (!property.words.empty()) schema["enum"] = property.words;
  return schema;
}

Json answer(std::string_view description, std::string_view type) {
  Json content;
  content[std::string(type)] = {{"schema", {{"type", "object"}}}};
  return {{"description", description}, {"content", std::move(content)}};
}

Json get(std::string_view id, std::string_view summary, std::string_view type, Json parameters = Json::array()) {
  return {
      {"get",
       {{"operationId", id},
        {"summary", summary},
        {"parameters", std::move(parameters)},
        {"responses",
         {{"200", answer(summary, type)}, {"default", answer("Why not (RFC 9457)", "application/problem+json")}}}}}};
}

Json items_parameters(map::LayerKind layer) {
  Json const number{{"type", "number"}};
  Json list = Json::array({
      parameter("bbox", {{"type", "array"}, {"minItems", 4}, {"maxItems", 6}, {"items", number}},
                "west,south,east,north in degrees"),
      parameter("datetime", {{"type", "string"}}, "A time, or two with a slash between them: when it was told of"),
      parameter("limit",
                {{"type", "integer"},
                 {"minimum", 1},
                 {"maximum", FeatureQuery::most},
                 {"default", FeatureQuery::usual_limit}},
                "How many at once"),
      parameter("offset", {{"type", "integer"}, {"minimum", 0}, {"default", 0}}, "How many to pass over"),
      parameter("site", {{"type", "string"}}, ""),
      parameter("floor", {{"type", "string"}}, ""),
      parameter("writer", {{"type", "string"}}, "Who told of it"),
  });
  for (auto const& property : map::properties_of(layer))
    list.push_back(parameter(property.name, schema_of(property), property.doc));
  return list;
}

}  // namespace

Json ogc_api_document(std::string const& origin) {
  constexpr std::string_view json = "application/json";
  constexpr std::string_view geojson = "application/geo+json";
  Json paths{{"/", get("getLandingPage", "What there is", json)},
             {"/conformance", get("getConformance", "Which standards this holds", json)},
             {"/collections", get("getCollections", "Layers and grids", json)}};
  for (auto const layer : map::all_layers) {
    auto const name = map::name_of(layer);
    auto const address = fmt::format("/collections/{}", name);
    paths[address] = get(fmt::format("describe_{}", name), fmt::format("The layer {}", name), json);
    paths[address + "/items"] =
        get(fmt::format("get_{}", name), fmt::format("Features of {}", name), geojson, items_parameters(layer));
    paths[address + "/items/{featureId}"] =
        get(fmt::format("get_one_of_{}", name), fmt::format("One feature of {}", name), geojson,
            Json::array({parameter("featureId", {{"type", "string"}}, "", "path")}));
  }
  return {{"openapi", "3.0.3"},
          {"info", {{"title", "Lapwing map"}, {"version", "1"}, {"license", {{"name", "Apache-2.0"}}}}},
          {"servers", Json::array({{{"url", origin + "/ogc"}}})},
          {"paths", std::move(paths)}};
}

}  // namespace lapwing::station
