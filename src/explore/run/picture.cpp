#include "explore/run/picture.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

namespace lapwing::explore {

namespace {

/// Told apart by people who see red and green alike (Okabe & Ito 2008).
constexpr std::array<std::string_view, 8> colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                     "#e69f00", "#56b4e9", "#7f7f00", "#000000"};

enum class Look : std::uint8_t { nothing, seen, missed, wall };

Look look_of(Exploration const& exploration, Cell cell) {
  auto const knowledge = exploration.map().at(cell);
  if (knowledge == Knowledge::wall) return Look::wall;
  if (knowledge == Knowledge::free) return Look::seen;
  return exploration.world().is_wanted()[cell] != 0 ? Look::missed : Look::nothing;
}

std::string_view fill_of(Look look) {
  switch (look) {
    case Look::seen: return "#ffffff";
    case Look::missed: return "#e03030";
    case Look::wall: return "#202020";
    case Look::nothing: break;
  }
  return "";
}

}  // namespace

std::string svg_of(Exploration const& exploration) {
  auto const& map = exploration.map();
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#c8c8c8\"/>\n<g shape-rendering=\"crispEdges\">\n",
      map.width(), map.height());
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width();) {
      auto const look = look_of(exploration, {x, y});
      int const begin = x;
      while (x < map.width() && look_of(exploration, {x, y}) == look) ++x;
      if (look != Look::nothing)
        svg += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"1\" fill=\"{}\"/>\n", begin,
                           map.height() - 1 - y, x - begin, fill_of(look));
    }
  }
  svg += "</g>\n";
  auto const starts = exploration.report().starts;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    auto const colour = colours[i % colours.size()];
    auto const at = [&](Place const& place) {
      return fmt::format("{:.1f},{:.1f}", place.x() / map.cell_m(), map.height() - place.y() / map.cell_m());
    };
    svg += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\" points=\"", colour);
    for (auto const& place : exploration.track(i)) svg += at(place) + ' ';
    svg += fmt::format("\"/>\n<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n",
                       starts[i].position.x() / map.cell_m(), map.height() - starts[i].position.y() / map.cell_m(),
                       colour);
  }
  return svg + "</svg>\n";
}

}  // namespace lapwing::explore
