#include "host/car_park/car_park_look.hpp"

#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/text/utc_text.hpp"

namespace lapwing::host {

using base::ErrorKind;
using base::fail;
using nlohmann::json;

namespace {

constexpr std::size_t most_things = 10'000;
constexpr double farthest_m = 100'000.0;

std::unexpected<base::Error> misfit(std::string_view why) {
  return fail(ErrorKind::invalid_input, fmt::format("what goes to and from lapwing overlook: {}", why));
}

/// So many finite numbers, none beyond any car park; nothing for anything else.
template <std::size_t count>
std::optional<std::array<double, count>> numbers_in(json const& value) {
  if (!value.is_array() || value.size() != count) return std::nullopt;
  std::array<double, count> numbers{};
  for (std::size_t i = 0; i < count; ++i) {
    if (!value[i].is_number()) return std::nullopt;
    numbers[i] = value[i].get<double>();
    if (!(std::abs(numbers[i]) <= farthest_m)) return std::nullopt;
  }
  return numbers;
}

template <std::size_t count>
std::optional<std::array<double, count>> numbers_at(json const& head, std::string_view key) {
  auto const found = head.find(key);
  return found == head.end() ? std::nullopt : numbers_in<count>(*found);
}

std::optional<double> chance_at(json const& head, std::string_view key) {
  auto const found = head.find(key);
  if (found == head.end() || !found->is_number()) return std::nullopt;
  auto const chance = found->get<double>();
  return chance >= 0.0 && chance <= 1.0 ? std::optional(chance) : std::nullopt;
}

std::optional<std::string> text_at(json const& head, std::string_view key) {
  auto const found = head.find(key);
  return found == head.end() || !found->is_string() ? std::nullopt : std::optional(found->get<std::string>());
}

std::optional<base::UtcTime> time_in(json const& head) {
  auto const text = text_at(head, "at");
  return text ? base::utc_from_text(*text) : std::nullopt;
}

json json_of(geo::Wgs84 const& place) {
  return {place.lat_deg(), place.lon_deg(), place.alt_m};
}

std::optional<geo::Wgs84> anchor_in(json const& head) {
  auto const numbers = numbers_at<3>(head, "anchor");
  if (!numbers || std::abs((*numbers)[0]) > 90.0 || std::abs((*numbers)[1]) > 180.0) return std::nullopt;
  return geo::Wgs84::from_degrees((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

json json_of(DownwardPose const& pose) {
  return {pose.position.x(), pose.position.y(), pose.position.z(), pose.yaw_rad};
}

std::optional<DownwardPose> pose_in(json const& head) {
  auto const numbers = numbers_at<4>(head, "pose");
  if (!numbers) return std::nullopt;
  return DownwardPose{{(*numbers)[0], (*numbers)[1], (*numbers)[2]}, (*numbers)[3]};
}

json json_of(explore::Corners const& corners) {
  auto value = json::array();
  for (auto const& corner : corners) value.push_back({corner.x(), corner.y()});
  return value;
}

std::optional<explore::Corners> outline_in(json const& thing) {
  auto const list = thing.is_object() ? thing.find("outline") : thing.end();
  if (!thing.is_object() || list == thing.end() || !list->is_array() || list->size() != 4) return std::nullopt;
  explore::Corners corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    auto const numbers = numbers_in<2>((*list)[i]);
    if (!numbers) return std::nullopt;
    corners[i] = {(*numbers)[0], (*numbers)[1]};
  }
  return corners;
}

/// Null when it is no list, or one that is too long.
json const* list_at(json const& head, std::string_view key) {
  auto const found = head.find(key);
  return found == head.end() || !found->is_array() || found->size() > most_things ? nullptr : &*found;
}

LookFrame request_for(char const* look, CarParkPlace const& place, base::UtcTime at) {
  LookFrame request{.head = {{"look", look}, {"world", place.world.string()}, {"at", base::utc_text(at)}}};
  if (place.anchor) request.head["anchor"] = json_of(*place.anchor);
  return request;
}

base::Result<TruthQuestion> question_in(json const& head) {
  auto const world = text_at(head, "world");
  auto const at = time_in(head);
  if (!world || world->empty() || !at) return misfit("a request without a world or a time");
  TruthQuestion question{.place = {.world = *world, .anchor = anchor_in(head)}, .at = *at};
  if (head.contains("anchor") && !question.place.anchor) return misfit("an anchor that is no place");
  return question;
}

}  // namespace

LookFrame look_request(CarParkLook const& look) {
  auto request = request_for(car_park_look, look.place, look.at);
  auto const& lens = look.lens;
  request.head["width"] = lens.width_px;
  request.head["height"] = lens.height_px;
  request.head["view_rad"] = 2.0 * std::atan2(0.5 * lens.width_px, lens.focal_x_px);
  request.head["pose"] = json_of(look.pose);
  return request;
}

base::Result<CarParkLook> look_in(LookFrame const& request) {
  auto question = question_in(request.head);
  if (!question) return std::unexpected(question.error());
  auto const size =
      numbers_in<3>(json::array({request.head.value("width", json()), request.head.value("height", json()),
                                 request.head.value("view_rad", json())}));
  auto const pose = pose_in(request.head);
  if (!size || !pose) return misfit("a request without a picture's size or the camera's pose");
  constexpr double least_px = 16.0;
  constexpr double most_px = 8'192.0;
  constexpr double widest_rad = 2.8;
  auto const [width, height, view_rad] = *size;
  bool const is_sound = width >= least_px && width <= most_px && height >= least_px && height <= most_px;
  if (!is_sound || !(view_rad > 0.0 && view_rad <= widest_rad)) return misfit("a picture of no sound size");
  return CarParkLook{.place = std::move(question->place),
                     .lens = geo::pinhole(static_cast<int>(width), static_cast<int>(height), view_rad),
                     .at = question->at,
                     .pose = *pose};
}

LookFrame look_answer(std::optional<explore::LotSight> const& sight) {
  LookFrame answer;
  if (!sight) return answer;
  answer.head = {{"slots", json::array()}, {"cars", json::array()}};
  for (auto const& slot : sight->slots) {
    json value{{"outline", json_of(slot.outline)}, {"surety", slot.surety}};
    if (slot.taken_chance) value["taken"] = *slot.taken_chance;
    answer.head["slots"].push_back(std::move(value));
  }
  for (auto const& car : sight->cars)
    answer.head["cars"].push_back({{"outline", json_of(car.outline)}, {"chance", car.chance}});
  return answer;
}

base::Result<std::optional<explore::LotSight>> sight_in(LookFrame const& answer, CarParkLook const& asked,
                                                        double ground_m) {
  if (auto const why = refusal_in(answer)) return fail(ErrorKind::invalid_input, *why);
  if (!answer.head.contains("slots")) return std::nullopt;
  auto const* const slots = list_at(answer.head, "slots");
  auto const* const cars = list_at(answer.head, "cars");
  if (!slots || !cars) return misfit("an answer without lists of slots and cars");
  explore::LotSight sight{.vehicle = {}, .at = asked.at, .view = view_of(asked.lens, asked.pose, ground_m)};
  for (auto const& value : *slots) {
    auto const outline = outline_in(value);
    auto const surety = outline ? chance_at(value, "surety") : std::nullopt;
    if (!surety) return misfit("a slot without a sound outline or surety");
    sight.slots.push_back({.outline = *outline, .surety = *surety, .taken_chance = chance_at(value, "taken")});
  }
  for (auto const& value : *cars) {
    auto const outline = outline_in(value);
    auto const chance = outline ? chance_at(value, "chance") : std::nullopt;
    if (!chance) return misfit("a car without a sound outline or chance");
    sight.cars.push_back({.outline = *outline, .chance = *chance});
  }
  return sight;
}

LookFrame truth_request(CarParkPlace const& place, base::UtcTime at) {
  return request_for(car_park_truth, place, at);
}

base::Result<TruthQuestion> truth_question_in(LookFrame const& request) {
  return question_in(request.head);
}

LookFrame truth_answer(CarParkTruth const& truth) {
  LookFrame answer{.head = {{"anchor", json_of(truth.anchor)}, {"ground_m", truth.ground_m}, {"slots", json::array()}}};
  for (auto const& slot : truth.slots)
    answer.head["slots"].push_back({{"outline", json_of(slot.outline)}, {"is_taken", slot.is_taken}});
  return answer;
}

base::Result<CarParkTruth> truth_in(LookFrame const& answer) {
  if (auto const why = refusal_in(answer)) return fail(ErrorKind::invalid_input, *why);
  auto const anchor = anchor_in(answer.head);
  auto const ground = numbers_in<1>(json::array({answer.head.value("ground_m", json())}));
  auto const* const slots = list_at(answer.head, "slots");
  if (!anchor || !ground || !slots) return misfit("an answer without an anchor, a ground or a list of slots");
  CarParkTruth truth{.anchor = *anchor, .ground_m = (*ground)[0]};
  for (auto const& value : *slots) {
    auto const outline = outline_in(value);
    if (!outline || !value.contains("is_taken") || !value["is_taken"].is_boolean())
      return misfit("a true slot without a sound outline, or that is neither free nor taken");
    truth.slots.push_back({.outline = *outline, .is_taken = value["is_taken"].get<bool>()});
  }
  return truth;
}

geo::GroundView view_of(geo::Lens const& lens, DownwardPose const& pose, double ground_m) {
  return {.lens = lens, .site_from_camera = geo::camera_at(pose.position, pose.yaw_rad, 0.0), .ground_up_m = ground_m};
}

}  // namespace lapwing::host
