#include "host/eyes/sign_look.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace lapwing::host {

using base::ErrorKind;
using base::fail;
using nlohmann::json;

namespace {

constexpr std::size_t most_signs = 100;
constexpr std::size_t longest_text = 200;

std::unexpected<base::Error> no_answer(std::string_view why) {
  return fail(ErrorKind::invalid_input, fmt::format("no answer to a look for signs: {}", why));
}

/// Nothing where it is no number, or one beyond any picture.
std::optional<double> number_in(json const& value) {
  constexpr double beyond = 1e6;
  if (!value.is_number()) return std::nullopt;
  auto const number = value.get<double>();
  return std::abs(number) <= beyond ? std::optional(number) : std::nullopt;
}

std::optional<vision::Box> box_in(json const& sign) {
  auto const box = sign.find("box");
  if (box == sign.end() || !box->is_array() || box->size() != 4) return std::nullopt;
  auto const x = number_in((*box)[0]);
  auto const y = number_in((*box)[1]);
  auto const width = number_in((*box)[2]);
  auto const height = number_in((*box)[3]);
  if (!x || !y || !width || !height || *width < 0.0 || *height < 0.0) return std::nullopt;
  return vision::Box{.x = *x, .y = *y, .width = *width, .height = *height};
}

/// False for what is there and no text.
bool read_text(json const& sign, std::string_view key, std::optional<std::string>& text) {
  auto const found = sign.find(key);
  if (found == sign.end()) return true;
  if (!found->is_string() || found->get_ref<std::string const&>().size() > longest_text) return false;
  text = found->get<std::string>();
  return true;
}

json json_of(vision::Detection const& sign, std::size_t crop_bytes) {
  auto const& box = sign.box;
  json value{{"box", {box.x, box.y, box.width, box.height}}, {"score", sign.score}, {"crop_bytes", crop_bytes}};
  if (sign.text) value["text"] = *sign.text;
  if (sign.kind) value["kind"] = *sign.kind;
  return value;
}

/// Nothing for what is no sign.
std::optional<vision::Detection> sign_in(json const& value) {
  if (!value.is_object()) return std::nullopt;
  auto const box = box_in(value);
  auto const score = value.contains("score") ? number_in(value["score"]) : std::nullopt;
  vision::Detection sign{.category = "sign", .box = box.value_or(vision::Box()), .score = score.value_or(-1.0)};
  bool const is_one = box && sign.score >= 0.0 && sign.score <= 1.0;
  if (!is_one || !read_text(value, "text", sign.text) || !read_text(value, "kind", sign.kind)) return std::nullopt;
  return sign;
}

}  // namespace

LookFrame sign_request(LookPicture picture) {
  LookFrame request{.head = {{"look", sign_look}}};
  put_picture(request, std::move(picture));
  return request;
}

LookFrame sign_answer(SignsSeen seen) {
  LookFrame answer{.head = {{"signs", json::array()}, {"is_sharp", seen.is_sharp}}};
  for (auto const& [sign, crop] : seen.signs) {
    answer.head["signs"].push_back(json_of(sign, crop.size()));
    answer.body += crop;
  }
  return answer;
}

base::Result<SignsSeen> signs_in(LookFrame const& answer) {
  if (auto const why = refusal_in(answer)) return fail(ErrorKind::invalid_input, *why);
  auto const list = answer.head.find("signs");
  auto const sharp = answer.head.find("is_sharp");
  if (list == answer.head.end() || !list->is_array() || list->size() > most_signs) return no_answer("no list of signs");
  if (sharp == answer.head.end() || !sharp->is_boolean()) return no_answer("it does not say whether they are sharp");
  SignsSeen seen{.is_sharp = sharp->get<bool>()};
  std::size_t at = 0;
  for (auto const& value : *list) {
    auto const sign = sign_in(value);
    if (!sign) return no_answer("a sign without a sound box, score or text");
    auto const bytes = static_cast<std::size_t>(count_in(value, "crop_bytes").value_or(0));
    if (bytes > answer.body.size() - at) return no_answer("its pictures are cut off");
    seen.signs.push_back({.sign = *sign, .crop = answer.body.substr(at, bytes)});
    at += bytes;
  }
  return seen;
}

}  // namespace lapwing::host
