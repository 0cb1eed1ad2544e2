#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/verb.hpp"
#include "apps/vision/detect.hpp"
#include "apps/vision/sign_readers.hpp"
#include "apps/vision/truth.hpp"
#include "host/files/files.hpp"
#include "vision/doors/classic.hpp"
#include "vision/doors/door_network.hpp"
#include "vision/doors/door_shape.hpp"
#include "vision/signs/door_signs.hpp"
#include "vision/signs/sign_finder.hpp"

namespace lapwing::apps::detect {

namespace {

using base::ErrorKind;

struct DoorOptions {
  CommonOptions common;
  std::string method = "network";
  std::string colour;
  double least_score = 0.2;  // the best F1 on photographs of the cross-validation and on rendered rooms
  std::filesystem::path truth;
  bool without_signs = false;
};

/// "H,S,V-H,S,V".
std::optional<vision::DoorColour> colour_of(std::string_view text) {
  std::array<int, 6> values{};
  constexpr std::string_view between = ",,-,,";
  constexpr std::array most{179, 255, 255, 179, 255, 255};
  auto const* at = text.data();
  auto const* const end = text.data() + text.size();
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k > 0) {
      if (at == end || *at != between[k - 1]) return std::nullopt;
      ++at;
    }
    auto const [rest, error] = std::from_chars(at, end, values[k]);
    if (error != std::errc() || values[k] < 0 || values[k] > most[k]) return std::nullopt;
    at = rest;
  }
  if (at != end) return std::nullopt;
  return vision::DoorColour{{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
}

using DoorFinder = std::function<std::vector<vision::Detection>(cv::Mat const& upright)>;

base::Result<vision::DoorColour> door_colour(DoorOptions const& options) {
  if (options.colour.empty()) return vision::DoorColour();
  if (auto const given = colour_of(options.colour)) return *given;
  return base::fail(ErrorKind::invalid_input, fmt::format("--colour {}: not a range of colours", options.colour),
                    "hue (0 to 179), saturation and value (0 to 255), lowest and highest: 5,60,40-25,255,230");
}

base::Result<DoorFinder> finder(DoorOptions const& options) {
  auto const colour = door_colour(options);
  if (!colour) return std::unexpected(colour.error());
  auto const least = options.least_score;
  if (options.method == "classic") {
    return [colour = *colour, least](cv::Mat const& upright) {
      auto doors = vision::doors_by_colour(upright, colour);
      std::erase_if(doors, [least](auto const& door) { return door.score < least; });
      return doors;
    };
  }
  auto const file = host::home_directory() / "models/doors.onnx";
  if (!std::filesystem::exists(file))
    return base::fail(ErrorKind::not_found, fmt::format("{} is not there", file.string()),
                      "it comes with the checkout; --method classic does without");
  auto network = vision::DoorNetwork::load(content_of(file));
  if (!network) return std::unexpected(network.error());
  return [network = std::make_shared<vision::DoorNetwork>(*std::move(network)), least](cv::Mat const& upright) {
    return network->find(upright, least);
  };
}

/// Each door as it is seen, for whoever wants to look at it from the front.
void give_corners(cv::Mat const& upright, std::vector<vision::Detection>& doors) {
  for (auto& door : doors) {
    auto const shape = vision::door_shape(upright, door.box);
    auto& corners = door.corners.emplace();
    for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = {shape.corners[k].x, shape.corners[k].y};
  }
}

/// Those of the whole picture, and of each door that has none of these what is on it and beside it, from the front.
void read_signs(vision::SignFinder& signs, cv::Mat const& upright, std::vector<vision::Detection>& found) {
  auto const doors = static_cast<std::ptrdiff_t>(found.size());
  for (auto& sign : signs.find(upright)) found.push_back(std::move(sign));
  vision::name_doors(found);
  std::vector<vision::Detection> more;
  for (auto const& door : std::vector(found.begin(), found.begin() + doors)) {
    if (door.text || door.kind) continue;
    for (auto& sign : vision::signs_of_door(signs, upright, door)) more.push_back(std::move(sign));
  }
  for (auto& sign : more) {
    if (!std::ranges::any_of(found, [&](auto const& other) {
          return other.category == "sign" && vision::overlap(other.box, sign.box) > 0.0;
        }))
      found.push_back(std::move(sign));
  }
  vision::name_doors(found);
}

int judge(DoorOptions const& options, Outcome const& outcome) {
  auto const evaluation = evaluate_with(options.truth, outcome.found, "door");
  if (!evaluation) return host::refuse(evaluation.error());
  auto const& doors = evaluation->things;
  // Beside the JSON of standard output.
  auto* const out = options.common.as_json ? stderr : stdout;
  if (doors.pictures > 0)
    fmt::print(out,
               "doors: {} pictures, {} doors: precision {:.3f}, recall {:.3f}, {:.2f} false a picture, average "
               "precision {:.3f}\n",
               doors.pictures, doors.there, doors.precision(), doors.recall(), doors.wrong_a_picture(),
               doors.average_precision);
  if (evaluation->signs > 0)
    fmt::print(out, "signs: {} of {} read exactly\n", evaluation->right_signs, evaluation->signs);
  return outcome.exit_code;
}

int doors(DoorOptions const& options) {
  auto const find = finder(options);
  if (!find) return host::refuse(find.error());
  std::optional<vision::SignFinder> signs;
  if (!options.without_signs) {
    auto all = sign_readers();
    if (!all) return host::refuse(all.error());
    signs.emplace(*std::move(all));
  }
  auto const outcome = carry_out(options.common, [&](std::size_t, cv::Mat const& upright, vision::FlightRecord const&) {
    auto found = (*find)(upright);
    give_corners(upright, found);
    if (signs) read_signs(*signs, upright, found);
    return Seen{.detections = std::move(found)};
  });
  return options.truth.empty() ? outcome.exit_code : judge(options, outcome);
}

}  // namespace

void add_doors(CLI::App& detect, int& exit_code) {
  auto const options = std::make_shared<DoorOptions>();
  auto* const part = detect.add_subcommand("doors", "Doors, and what is written on the signs beside them");
  add_common_options(*part, options->common);
  part->add_option("--method", options->method, "network: doors of any colour; classic: by their colour")
      ->check(CLI::IsMember({"network", "classic"}))
      ->capture_default_str();
  part->add_option("--colour", options->colour,
                   "Of the doors, for the classic way: H,S,V-H,S,V; default: wood and brown");
  part->add_option("--least-score", options->least_score, "Doors that are less sure are not told, 0 to 1")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  part->add_flag("--no-signs", options->without_signs, "Leave signs unread");
  part->add_option("--truth", options->truth, "Folder with what people marked in these pictures: says how good it is")
      ->check(CLI::ExistingDirectory);
  part->callback([options, &exit_code] { exit_code = doors(*options); });
}

}  // namespace lapwing::apps::detect
