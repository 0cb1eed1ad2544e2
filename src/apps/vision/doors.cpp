#include <array>
#include <charconv>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "apps/verb.hpp"
#include "apps/vision/detect.hpp"
#include "vision/doors/classic.hpp"

namespace lapwing::apps::detect {

namespace {

using base::ErrorKind;

struct DoorOptions {
  CommonOptions common;
  std::string method = "classic";
  std::string colour;
};

/// "H,S,V-H,S,V".
std::optional<vision::DoorColour> colour_of(std::string_view text) {
  std::array<int, 6> values{};
  constexpr std::string_view between = ",,-,,";
  constexpr std::array most{179, 255, 255, 179, 255, 255};
  auto const* at = text.data();
  auto const* const end = text.data() + text.size();
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k > 0 && (at == end || *at++ != between[k - 1])) return std::nullopt;
    auto const [rest, error] = std::from_chars(at, end, values[k]);
    if (error != std::errc() || values[k] < 0 || values[k] > most[k]) return std::nullopt;
    at = rest;
  }
  if (at != end) return std::nullopt;
  return vision::DoorColour{{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
}

int doors(DoorOptions const& options) {
  vision::DoorColour colour;
  if (!options.colour.empty()) {
    auto const given = colour_of(options.colour);
    if (!given) {
      auto const message = fmt::format("--colour {}: not a range of colours", options.colour);
      return host::refuse({ErrorKind::invalid_input, message,
                           "hue (0 to 179), saturation and value (0 to 255), lowest and highest: 5,60,40-25,255,230"});
    }
    colour = *given;
  }
  return carry_out(options.common,
                   [&colour](cv::Mat const& upright) { return vision::doors_by_colour(upright, colour); })
      .exit_code;
}

}  // namespace

void add_doors(CLI::App& detect, int& exit_code) {
  auto const options = std::make_shared<DoorOptions>();
  auto* const part = detect.add_subcommand("doors", "Doors, and what is written on the signs beside them");
  add_common_options(*part, options->common);
  part->add_option("--method", options->method, "classic: by the doors' colour")
      ->check(CLI::IsMember({"classic"}))
      ->capture_default_str();
  part->add_option("--colour", options->colour,
                   "Of the doors, for the classic way: H,S,V-H,S,V; default: wood and brown");
  part->callback([options, &exit_code] { exit_code = doors(*options); });
}

}  // namespace lapwing::apps::detect
