#include "sim/building/plan/building_file.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/config.hpp"
#include "geo/anchor.hpp"
#include "sim/building/picture/letters.hpp"
#include "sim/building/plan/door_opening.hpp"

namespace lapwing::sim::building {

namespace {

using base::ConfigReader;
using base::Placed;
using base::config_kinds::invalid_value;

constexpr double full_turn_deg = 360.0;
constexpr double most_door_angle_deg = 120.0;
constexpr std::size_t most_sign_lines = 3;
constexpr std::size_t most_line_letters = 16;
constexpr std::size_t most_name_bytes = 100;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

Place place_of(std::vector<double> const& numbers) {
  return {numbers[0], numbers[1]};
}

/// Reads what several kinds of parts have in common.
class Parts {
 public:
  explicit Parts(base::Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void wrong(base::DiagnosticKind const& kind, base::Span span, std::string message, base::Hint hint = {}) {
    diagnostics_.report(kind, span, std::move(message), std::move(hint));
  }
  void missing(base::Span span, std::string_view what, std::string_view key) {
    wrong(invalid_value, span, fmt::format("{} needs {}", what, key));
  }

  [[nodiscard]] std::optional<Place> place(ConfigReader& reader, std::string_view key) {
    auto const numbers = reader.numbers(key, 2, -most_far_m, most_far_m);
    return numbers ? std::optional(place_of(numbers->value)) : std::nullopt;
  }
  [[nodiscard]] std::vector<Place> places(ConfigReader& reader, std::string_view key) {
    std::vector<Place> places;
    for (auto const& numbers : reader.number_lists(key, 2, -most_far_m, most_far_m))
      places.push_back(place_of(numbers.value));
    return places;
  }
  /// `at`, and `angle_key` in degrees.
  [[nodiscard]] std::optional<Pose> pose(Placed<ConfigReader>& part, std::string_view what,
                                         std::string_view angle_key) {
    auto const at = place(part.value, "at");
    if (!at && !part.value.has("at")) missing(part.span, what, "a place: at = [x, y]");
    auto const angle = part.value.number(angle_key, -full_turn_deg, full_turn_deg);
    return at ? std::optional(Pose{*at, angle ? radians(angle->value) : 0.0}) : std::nullopt;
  }
  void number(ConfigReader& reader, std::string_view key, double low, double high, double& into) {
    if (auto const number = reader.number(key, low, high)) into = number->value;
  }
  [[nodiscard]] std::optional<Colour> colour(ConfigReader& reader, std::string_view key) {
    auto const text = reader.text(key);
    if (!text) return std::nullopt;
    std::uint32_t rgb = 0;
    char const* const begin = text->value.data() + 1;
    char const* const end = text->value.data() + text->value.size();
    if (text->value.size() != 7 || text->value.front() != '#' || std::from_chars(begin, end, rgb, 16).ptr != end) {
      wrong(invalid_value, text->span, fmt::format("{} must be a colour, not {}", key, text->value),
            "as in \"#8a5c34\": red, green and blue");
      return std::nullopt;
    }
    auto const part = [rgb](unsigned shift) { return static_cast<double>((rgb >> shift) & 0xffU) / 255.0; };
    return Colour{part(16), part(8), part(0)};
  }
  template <class T>
  void choice(ConfigReader& reader, std::string_view key, std::vector<std::pair<std::string_view, T>> const& choices,
              T& into) {
    auto const text = reader.text(key);
    if (!text) return;
    std::vector<std::string_view> words;
    for (auto const& [word, value] : choices) {
      if (word == text->value) {
        into = value;
        return;
      }
      words.push_back(word);
    }
    wrong(invalid_value, text->span, fmt::format("{} cannot be {}", key, text->value),
          fmt::format("it can be {}", fmt::join(words, ", ")));
  }
  [[nodiscard]] std::string name(ConfigReader& reader, std::string_view key, std::string otherwise) {
    auto text = reader.text(key);
    if (!text) return otherwise;
    if (text->value.empty() || text->value.size() > most_name_bytes)
      wrong(invalid_value, text->span, fmt::format("{} must have 1 to {} letters", key, most_name_bytes));
    return std::move(text->value);
  }

 private:
  base::Diagnostics& diagnostics_;
};

void read_material(Parts& parts, ConfigReader& reader, Material& into) {
  parts.choice<Material>(reader, "material",
                         {{"plaster", Material::plaster},
                          {"wood", Material::wood},
                          {"cloth", Material::cloth},
                          {"dark", Material::dark},
                          {"glass", Material::glass}},
                         into);
}

void read_wall(Parts& parts, Placed<ConfigReader>& part, double thickness_m, BuildingPlan& plan) {
  auto& reader = part.value;
  WallPlan wall{.from = {}, .to = {}, .thickness_m = thickness_m};
  parts.number(reader, "thickness_m", 0.02, 2.0, wall.thickness_m);
  wall.colour = parts.colour(reader, "colour");
  read_material(parts, reader, wall.material);
  auto line = parts.places(reader, "line");
  auto const closed = reader.flag("closed");
  if (line.size() < 2) {
    parts.missing(part.span, "a wall", "two places at least: line = [[x, y], [x, y]]");
    return;
  }
  if (closed && closed->value) line.push_back(line.front());
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    if (distance_m(line[i], line[i + 1]) < 0.01) {
      parts.wrong(invalid_value, part.span, fmt::format("places {} and {} of the wall's line are one", i + 1, i + 2));
      return;
    }
    wall.from = line[i];
    wall.to = line[i + 1];
    plan.walls.push_back(wall);
  }
}

void check_sign(Parts& parts, Placed<std::string> const& sign) {
  std::size_t lines = 1;
  std::size_t letters = 0;
  for (char const letter : sign.value) {
    if (letter == '\n') {
      ++lines;
      letters = 0;
    } else if (!has_letter(letter)) {
      parts.wrong(invalid_value, sign.span, "the sign has letters that the building has not",
                  fmt::format("it has blanks and {}", known_letters()));
      return;
    } else if (++letters > most_line_letters) {
      parts.wrong(invalid_value, sign.span, fmt::format("a line of a sign has {} letters at most", most_line_letters));
      return;
    }
  }
  if (lines > most_sign_lines)
    parts.wrong(invalid_value, sign.span, fmt::format("a sign has {} lines at most", most_sign_lines));
}

void read_door(Parts& parts, Placed<ConfigReader>& part, BuildingPlan& plan) {
  auto& reader = part.value;
  auto const hinge = parts.place(reader, "hinge");
  auto const latch = parts.place(reader, "latch");
  DoorPlan door;
  door.id = parts.name(reader, "id", fmt::format("door {}", plan.doors.size() + 1));
  parts.choice<Side>(reader, "opens_to", {{"left", Side::left}, {"right", Side::right}}, door.opens_to);
  parts.number(reader, "height_m", 1.5, 4.0, door.height_m);
  if (auto const angle = reader.number("angle_deg", 0.0, most_door_angle_deg)) door.angle_rad = radians(angle->value);
  door.colour = parts.colour(reader, "colour");
  parts.choice<bool>(reader, "sign_on", {{"wall", false}, {"leaf", true}}, door.is_sign_on_leaf);
  if (auto sign = reader.text("sign")) {
    check_sign(parts, *sign);
    door.sign = std::move(sign->value);
  }
  constexpr double longest_s = 86'400.0;
  auto const open = reader.number("open_s", 1.0, longest_s);
  auto const closed = reader.number("closed_s", 1.0, longest_s);
  if (open && closed) door.habit = DoorHabit{open->value, closed->value};
  if (open.has_value() != closed.has_value())
    parts.wrong(building_kinds::misfit, part.span, "a door that moves needs both open_s and closed_s");
  if (!hinge || !latch) {
    if (!reader.has("hinge") || !reader.has("latch"))
      parts.missing(part.span, "a door", "both jambs: hinge = [x, y] and latch = [x, y]");
    return;
  }
  door.hinge = *hinge;
  door.latch = *latch;
  if (door.width_m() < 0.4 || door.width_m() > 3.0) {
    parts.wrong(invalid_value, part.span, fmt::format("the door is {:.2f} m wide", door.width_m()),
                "doors are 0.4 to 3 m wide");
    return;
  }
  plan.doors.push_back(std::move(door));
}

void read_person(Parts& parts, Placed<ConfigReader>& part, BuildingPlan& plan) {
  auto const start = parts.pose(part, "a person", "facing_deg");
  PersonPlan person;
  if (auto const walks = part.value.flag("walks")) person.walks = walks->value;
  person.way = parts.places(part.value, "way");
  if (!person.way.empty()) person.walks = true;
  parts.number(part.value, "speed_m_s", 0.1, 2.0, person.speed_m_s);
  if (!start) return;
  person.start = *start;
  plan.people.push_back(std::move(person));
}

void read_furniture(Parts& parts, Placed<ConfigReader>& part, BuildingPlan& plan) {
  auto const middle = parts.pose(part, "furniture", "turned_deg");
  auto const size = part.value.numbers("size", 3, 0.05, 50.0);
  FurniturePlan block;
  read_material(parts, part.value, block.material);
  if (auto const colour = parts.colour(part.value, "colour")) block.colour = *colour;
  if (!size && !part.value.has("size")) parts.missing(part.span, "furniture", "a size: size = [length, width, height]");
  if (!middle || !size) return;
  block.middle = *middle;
  block.length_m = size->value[0];
  block.width_m = size->value[1];
  block.height_m = size->value[2];
  plan.furniture.push_back(block);
}

void read_room(Parts& parts, Placed<ConfigReader>& part, BuildingPlan& plan) {
  RoomPlan room;
  room.name = parts.name(part.value, "name", fmt::format("room {}", plan.rooms.size() + 1));
  room.corners = parts.places(part.value, "corners");
  if (room.corners.size() < 3) {
    parts.missing(part.span, "a room", "three corners at least: corners = [[x, y], ...]");
    return;
  }
  plan.rooms.push_back(std::move(room));
}

void read_site(ConfigReader& reader, BuildingPlan& plan) {
  plan.anchor = geo::read_anchor(reader);
  constexpr double farthest_m = 10'000.0;
  auto const origin = reader.numbers("origin", 2, -farthest_m, farthest_m);
  auto const turned = reader.number("turned_deg", -full_turn_deg, full_turn_deg);
  plan.site_from_floor = {
      origin ? geo::Point<geo::SiteFrame>(origin->value[0], origin->value[1]) : geo::Point<geo::SiteFrame>(),
      turned ? radians(turned->value) : 0.0};
}

/// Calls `read` for each part, and reports what it did not ask for.
template <class Read>
void each_part(Parts& parts, ConfigReader& reader, std::string_view key, std::size_t most, Read const& read) {
  auto found = reader.tables(key);
  if (found.size() > most) {
    parts.wrong(building_kinds::too_large, found[most].span, fmt::format("there are more than {} [[{}]]", most, key));
    return;
  }
  for (auto& part : found) {
    read(part);
    part.value.refuse_unknown();
  }
}

void check_doors(Parts& parts, BuildingPlan const& plan, std::vector<base::Span> const& spans) {
  std::set<std::string_view> ids;
  std::vector<std::pair<Opening, std::size_t>> openings;
  for (std::size_t i = 0; i < plan.doors.size(); ++i) {
    auto const& door = plan.doors[i];
    if (!ids.insert(door.id).second)
      parts.wrong(building_kinds::misfit, spans[i], fmt::format("another door is called {}, too", door.id));
    auto const opening = opening_of(door, plan.walls);
    if (opening)
      openings.emplace_back(*opening, i);
    else
      parts.wrong(building_kinds::misfit, spans[i], fmt::format("{} stands in no wall", door.id),
                  "hinge and latch must both lie on one wall's line, to a centimetre");
  }
  std::ranges::sort(openings, [](auto const& a, auto const& b) {
    return std::pair(a.first.wall, a.first.begin_m) < std::pair(b.first.wall, b.first.begin_m);
  });
  for (std::size_t i = 1; i < openings.size(); ++i) {
    auto const& [before, first] = openings[i - 1];
    auto const& [after, second] = openings[i];
    if (before.wall == after.wall && after.begin_m < before.end_m)
      parts.wrong(building_kinds::misfit, spans[second],
                  fmt::format("{} and {} overlap", plan.doors[first].id, plan.doors[second].id));
  }
}

}  // namespace

BuildingPlan read_building(base::SourceFile const& source, base::Diagnostics& diagnostics) {
  BuildingPlan plan;
  Parts parts(diagnostics);
  if (source.text().size() > most_building_bytes) {
    parts.wrong(building_kinds::too_large, {0, 1},
                fmt::format("the file has more than {} MiB", most_building_bytes >> 20U));
    return plan;
  }
  auto const root = base::parse_config(source, diagnostics);
  if (diagnostics.has_errors()) return plan;
  ConfigReader reader(root, diagnostics);
  plan.name = parts.name(reader, "name", plan.name);
  read_site(reader, plan);
  parts.number(reader, "ceiling_m", 2.0, 20.0, plan.ceiling_m);
  double thickness_m = WallPlan{}.thickness_m;
  parts.number(reader, "wall_thickness_m", 0.02, 2.0, thickness_m);
  for (auto const& [key, into] :
       {std::pair("wall_colour", &plan.wall_colour), std::pair("floor_colour", &plan.floor_colour),
        std::pair("door_colour", &plan.door_colour)}) {
    if (auto const colour = parts.colour(reader, key)) *into = *colour;
  }
  constexpr std::size_t most_lines = 5'000;
  each_part(parts, reader, "wall", most_lines, [&](auto& part) { read_wall(parts, part, thickness_m, plan); });
  std::vector<base::Span> door_spans;
  each_part(parts, reader, "door", most_doors, [&](auto& part) {
    read_door(parts, part, plan);
    if (door_spans.size() < plan.doors.size()) door_spans.push_back(part.span);
  });
  each_part(parts, reader, "person", most_people, [&](auto& part) { read_person(parts, part, plan); });
  each_part(parts, reader, "furniture", most_furniture, [&](auto& part) { read_furniture(parts, part, plan); });
  each_part(parts, reader, "room", most_doors, [&](auto& part) { read_room(parts, part, plan); });
  each_part(parts, reader, "start", most_people, [&](auto& part) {
    if (auto const pose = parts.pose(part, "a start", "facing_deg")) plan.starts.push_back(*pose);
  });
  reader.refuse_unknown();
  if (plan.walls.size() > most_walls)
    parts.wrong(building_kinds::too_large, {0, 1}, fmt::format("the walls have more than {} pieces", most_walls));
  else if (plan.walls.empty())
    parts.wrong(building_kinds::misfit, {0, 1}, "the building has no wall", "[[wall]] with line = [[x, y], [x, y]]");
  else
    check_doors(parts, plan, door_spans);
  return plan;
}

base::Result<BuildingPlan> building_of(std::string name, std::string text) {
  base::SourceFile const source(std::move(name), std::move(text));
  base::Diagnostics diagnostics(source);
  auto plan = read_building(source, diagnostics);
  if (!diagnostics.has_errors()) return plan;
  return base::fail(base::ErrorKind::invalid_input, base::render(diagnostics));
}

}  // namespace lapwing::sim::building
