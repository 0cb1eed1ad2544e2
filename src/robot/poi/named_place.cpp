#include "robot/poi/named_place.hpp"

#include <algorithm>
#include <cctype>
#include <ranges>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geo/position.hpp"

namespace lapwing::robot {

namespace {

using map::PointOfInterest;

constexpr double one_door_m = 1.0;  ///< as tags are merged
constexpr std::size_t most_told = 4;

std::string lower(std::string_view text) {
  std::string small(text);
  std::ranges::transform(small, small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

/// Bytes of UTF-8 count as letters.
bool is_in_a_word(char c) {
  auto const byte = static_cast<unsigned char>(c);
  return std::isalnum(byte) != 0 || byte >= 0x80U;
}

/// Puts the pieces of `text` between what is not `is_inside` into `words`.
template <class IsInside>
void cut(std::string_view text, IsInside const& is_inside, std::set<std::string>& words) {
  auto at = text.begin();
  while (at != text.end()) {
    auto const begin = std::find_if(at, text.end(), is_inside);
    at = std::find_if_not(begin, text.end(), is_inside);
    if (begin != at) words.emplace(begin, at);
  }
}

/// In small letters. A number of several parts is a word, and so is each part of it: "itb-221", "itb" and "221".
std::set<std::string> words_of(std::string_view text) {
  std::set<std::string> words;
  auto const small = lower(text);
  cut(small, &is_in_a_word, words);
  cut(small, [](char c) { return is_in_a_word(c) || c == '-' || c == '.'; }, words);
  return words;
}

/// "room 221" and "door 221" are what people say of a door that is called "221".
std::set<std::string> telling_words_of(std::string_view name) {
  auto words = words_of(name);
  words.erase("room");
  words.erase("door");
  return words;
}

std::string label_of(PointOfInterest const& point) {
  return point.text.empty() ? point.name : point.text;
}

bool is_called(PointOfInterest const& point, std::string_view name) {
  auto const wanted = lower(name);
  return !wanted.empty() && (lower(point.name) == wanted || lower(point.text) == wanted);
}

bool has_the_name(PointOfInterest const& point, std::set<std::string> const& wanted) {
  return !wanted.empty() && telling_words_of(point.name) == wanted;
}

bool has_the_words(PointOfInterest const& point, std::set<std::string> const& wanted) {
  return !wanted.empty() && std::ranges::includes(words_of(point.name + ' ' + point.text), wanted);
}

template <class IsMeant>
std::vector<PointOfInterest const*> places_of(std::span<PointOfInterest const* const> points, IsMeant const& is_meant) {
  std::vector<PointOfInterest const*> places;
  for (auto const* point : points) {
    if (!is_meant(*point)) continue;
    bool const is_there = std::ranges::any_of(
        places, [&](auto const* place) { return geo::distance_m(place->position, point->position) < one_door_m; });
    if (!is_there) places.push_back(point);
  }
  return places;
}

}  // namespace

base::Result<map::SitePoint> place_called(std::string_view name, std::span<PointOfInterest const* const> points) {
  auto const wanted = telling_words_of(name);
  auto places = places_of(points, [&](auto const& point) { return is_called(point, name); });
  if (places.empty()) places = places_of(points, [&](auto const& point) { return has_the_name(point, wanted); });
  if (places.empty()) places = places_of(points, [&](auto const& point) { return has_the_words(point, wanted); });
  if (places.size() == 1) return places.front()->position;
  if (places.empty())
    return base::fail(base::ErrorKind::not_found, fmt::format("the map has no place called '{}' on its floor", name));
  std::vector<std::string> labels;
  for (auto const* place : places | std::views::take(most_told)) labels.push_back(label_of(*place));
  return base::fail(base::ErrorKind::not_found,
                    fmt::format("the map has {} places called '{}' on its floor: {}{}", places.size(), name,
                                fmt::join(labels, ", "), places.size() > most_told ? ", ..." : ""),
                    "say what only one of them is called");
}

}  // namespace lapwing::robot
