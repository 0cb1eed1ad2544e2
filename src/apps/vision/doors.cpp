#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/verb.hpp"
#include "apps/vision/detect.hpp"
#include "apps/vision/truth.hpp"
#include "host/files/files.hpp"
#include "vision/doors/classic.hpp"
#include "vision/signs/sign_finder.hpp"

namespace lapwing::apps::detect {

namespace {

using base::ErrorKind;

struct DoorOptions {
  CommonOptions common;
  std::string method = "classic";
  std::string colour;
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
    if (k > 0 && (at == end || *at++ != between[k - 1])) return std::nullopt;
    auto const [rest, error] = std::from_chars(at, end, values[k]);
    if (error != std::errc() || values[k] < 0 || values[k] > most[k]) return std::nullopt;
    at = rest;
  }
  if (at != end) return std::nullopt;
  return vision::DoorColour{{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
}

std::string content_of(std::filesystem::path const& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Tesseract, and the recogniser where set-up has made it: without it blurred signs are read less often, which is said.
base::Result<std::vector<std::unique_ptr<vision::LineReader>>> readers() {
  std::vector<std::unique_ptr<vision::LineReader>> all;
  auto tesseract = vision::make_tesseract_reader();
  if (!tesseract) return std::unexpected(tesseract.error());
  all.push_back(*std::move(tesseract));
  auto const folder = host::home_directory() / "build/models";
  auto const network = folder / "text-recogniser.onnx";
  if (!std::filesystem::exists(network)) {
    fmt::print(stderr,
               "signs are read by Tesseract alone; with {}, which ./lapwing makes, blurred ones are read better\n",
               network.string());
    return all;
  }
  auto recogniser = vision::make_recogniser(content_of(network), content_of(folder / "text-recogniser.txt"));
  if (!recogniser) return std::unexpected(recogniser.error());
  all.push_back(*std::move(recogniser));
  return all;
}

base::Result<vision::DoorColour> door_colour(DoorOptions const& options) {
  if (options.colour.empty()) return vision::DoorColour();
  if (auto const given = colour_of(options.colour)) return *given;
  return base::fail(ErrorKind::invalid_input, fmt::format("--colour {}: not a range of colours", options.colour),
                    "hue (0 to 179), saturation and value (0 to 255), lowest and highest: 5,60,40-25,255,230");
}

int judge(DoorOptions const& options, Outcome const& outcome) {
  auto const evaluation = evaluate_with(options.truth, outcome.found);
  if (!evaluation) return host::refuse(evaluation.error());
  auto const& doors = evaluation->doors;
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
  auto const colour = door_colour(options);
  if (!colour) return host::refuse(colour.error());
  std::optional<vision::SignFinder> signs;
  if (!options.without_signs) {
    auto all = readers();
    if (!all) return host::refuse(all.error());
    signs.emplace(*std::move(all));
  }
  auto const outcome = carry_out(options.common, [&](cv::Mat const& upright) {
    auto found = vision::doors_by_colour(upright, *colour);
    if (signs) {
      for (auto& sign : signs->find(upright)) found.push_back(std::move(sign));
      vision::name_doors(found);
    }
    return found;
  });
  return options.truth.empty() ? outcome.exit_code : judge(options, outcome);
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
  part->add_flag("--no-signs", options->without_signs, "Leave signs unread");
  part->add_option("--truth", options->truth, "Folder with what people marked in these pictures: says how good it is")
      ->check(CLI::ExistingDirectory);
  part->callback([options, &exit_code] { exit_code = doors(*options); });
}

}  // namespace lapwing::apps::detect
