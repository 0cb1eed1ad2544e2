#include "apps/vision/detect.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "apps/verb.hpp"
#include "base/files/replace_file.hpp"
#include "base/text/printable.hpp"
#include "geo/position_json.hpp"
#include "vision/annotate.hpp"

namespace lapwing::apps {

namespace detect {

namespace {

namespace fs = std::filesystem;
using base::ErrorKind;
using base::fail;

base::Result<std::string> read_picture(std::string const& path) {
  std::error_code error;
  auto const status = fs::status(path, error);
  if (!fs::exists(status)) return fail(ErrorKind::not_found, "no such file");
  if (!fs::is_regular_file(status)) return fail(ErrorKind::invalid_input, "not a file");
  if (auto const size = fs::file_size(path, error); !error && size > vision::max_picture_bytes)
    return fail(ErrorKind::invalid_input, fmt::format("{} MB is too large for a picture", size >> 20U),
                fmt::format("files of up to {} MB are read", vision::max_picture_bytes >> 20U));
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(ErrorKind::io, std::strerror(errno));
  return std::string(std::istreambuf_iterator<char>(file), {});
}

struct Photograph {
  vision::Image image;
  vision::FlightRecord flight;
};

base::Result<Photograph> photograph_of(std::string const& path) {
  auto const file = read_picture(path);
  if (!file) return std::unexpected(file.error());
  auto const bytes = std::as_bytes(std::span(*file));
  auto image = vision::decode_image(bytes);
  if (!image) return std::unexpected(image.error());
  return Photograph{*std::move(image), vision::read_flight(bytes)};
}

/// Named as the picture; pictures of one name from several folders are numbered.
std::string overlay_name(std::string const& picture, std::set<std::string>& taken) {
  auto const stem = fs::path(picture).stem().string();
  auto name = stem + ".overlay.jpg";
  for (int k = 2; !taken.insert(name).second; ++k) name = fmt::format("{}-{}.overlay.jpg", stem, k);
  return name;
}

double rounded(double value, double steps) {
  return std::round(value * steps) / steps;
}

nlohmann::json json_of(Found const& found, vision::Detection const& detection) {
  constexpr double tenths = 10.0;
  constexpr double thousandths = 1000.0;
  auto const& box = detection.box;
  nlohmann::json entry{
      {"image", found.picture},
      {"category", detection.category},
      {"bbox",
       {rounded(box.x, tenths), rounded(box.y, tenths), rounded(box.width, tenths), rounded(box.height, tenths)}},
      {"score", rounded(detection.score, thousandths)}};
  if (detection.text) entry["text"] = *detection.text;
  if (detection.kind) entry["kind"] = *detection.kind;
  if (detection.corners) {
    for (auto const& corner : *detection.corners)
      entry["corners"].push_back({rounded(corner.x, tenths), rounded(corner.y, tenths)});
  }
  if (detection.category == "slot") {
    entry["occupied"] = nullptr;
    if (detection.occupied_chance) {
      entry["occupied"] = *detection.occupied_chance >= 0.5;
      entry["occupied_chance"] = rounded(*detection.occupied_chance, thousandths);
    }
  }
  if (found.metres_a_pixel) entry["gsd_m"] = rounded(*found.metres_a_pixel, 1e5);
  if (detection.place) entry.update(geo::position_json(*detection.place));
  return entry;
}

nlohmann::json json_of(std::vector<Found> const& found) {
  auto all = nlohmann::json::array();
  for (auto const& one : found) {
    for (auto const& detection : one.detections) all.push_back(json_of(one, detection));
  }
  return all;
}

/// RFC 7946, of what has a place on Earth.
nlohmann::json geojson_of(std::vector<Found> const& found) {
  nlohmann::json all{{"type", "FeatureCollection"}, {"features", nlohmann::json::array()}};
  for (auto const& one : found) {
    for (auto const& detection : one.detections) {
      if (!detection.place) continue;
      auto properties = json_of(one, detection);
      for (auto const* const key : {"lat_deg", "lon_deg", "alt_m"}) properties.erase(key);
      all["features"].push_back(
          {{"type", "Feature"},
           {"geometry",
            {{"type", "Point"},
             {"coordinates",
              {geo::rounded(detection.place->lon_deg(), 7), geo::rounded(detection.place->lat_deg(), 7)}}}},
           {"properties", std::move(properties)}});
    }
  }
  return all;
}

/// Of a file's name, which may be any bytes.
std::string to_text(nlohmann::json const& json) {
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void tell(Found const& found) {
  if (found.detections.empty()) fmt::print("{}: nothing\n", found.picture);
  for (auto const& detection : found.detections) {
    auto const& box = detection.box;
    fmt::print("{}: {} {:.2f} at {:.0f},{:.0f} {:.0f}x{:.0f}{}{}\n", found.picture, detection.category, detection.score,
               box.x, box.y, box.width, box.height, detection.text ? " \"" + *detection.text + "\"" : "",
               detection.kind ? " " + *detection.kind : "");
  }
}

void to_stored(vision::Image const& image, vision::Detection& detection) {
  detection.box = image.to_stored(detection.box);
  if (!detection.corners) return;
  for (auto& corner : *detection.corners) {
    auto const stored = image.to_stored(vision::Box{.x = corner.x, .y = corner.y});
    corner = {stored.x, stored.y};
  }
}

base::Result<Found> look_at(std::size_t which, std::string const& picture, Detector const& detector,
                            fs::path const& overlay) {
  auto const photograph = photograph_of(picture);
  if (!photograph) return std::unexpected(photograph.error());
  auto const& [image, flight] = *photograph;
  auto seen = detector(which, image.upright(), flight);
  auto const size = image.stored.size();
  for (auto& detection : seen.detections) {
    to_stored(image, detection);
    auto const& box = detection.box;
    if (seen.metres_a_pixel)
      detection.place =
          vision::place_of({box.x + 0.5 * box.width, box.y + 0.5 * box.height}, size, flight, *seen.metres_a_pixel);
  }
  auto const drawn = vision::encode_jpeg(vision::annotated(image.stored, seen.detections));
  if (auto const written = base::replace_file(overlay, drawn); !written) return std::unexpected(written.error());
  return Found{picture, size, seen.metres_a_pixel, std::move(seen.detections)};
}

/// Into the folder; says so on standard error if that does not work.
bool is_written(fs::path const& file, std::string const& text) {
  auto const written = base::replace_file(file, text);
  if (!written) host::print_error(written.error());
  return written.has_value();
}

}  // namespace

void add_common_options(CLI::App& part, CommonOptions& options) {
  part.add_option("pictures", options.pictures, "JPEG, PNG or WebP files")->required();
  part.add_option("--out", options.out, "Folder for detections.json and the pictures with what was found drawn in")
      ->required();
  part.add_flag("--json", options.as_json, "Print detections.json instead of a line for each detection");
}

std::string content_of(fs::path const& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Outcome carry_out(CommonOptions const& options, Detector const& detector) {
  std::error_code error;
  fs::create_directories(options.out, error);
  if (error) {
    auto const message = fmt::format("{}: cannot make the folder: {}", options.out.string(), error.message());
    return {.found = {}, .exit_code = host::refuse({ErrorKind::invalid_input, message})};
  }
  Outcome outcome;
  std::set<std::string> taken;
  for (std::size_t which = 0; which < options.pictures.size(); ++which) {
    auto const& picture = options.pictures[which];
    auto found = look_at(which, picture, detector, options.out / overlay_name(picture, taken));
    if (!found) {
      auto wrong = found.error();
      if (!wrong.message.starts_with(options.out.string()))
        wrong.message = fmt::format("{}: {}", picture, wrong.message);
      host::print_error(wrong);
      outcome.exit_code = host::exit_usage;
      continue;
    }
    if (!options.as_json) tell(*found);
    outcome.found.push_back(*std::move(found));
  }
  auto const json = to_text(json_of(outcome.found));
  auto const geojson = geojson_of(outcome.found);
  bool const is_placed = !geojson["features"].empty();
  if (!is_written(options.out / "detections.json", json) ||
      (is_placed && !is_written(options.out / "detections.geojson", to_text(geojson))))
    outcome.exit_code = host::exit_usage;
  if (options.as_json) fmt::print("{}", json);
  return outcome;
}

}  // namespace detect

void add_detect(CLI::App& program, int& exit_code) {
  auto* const verb = begin_verb(program, "detect");
  verb->require_subcommand(1);
  detect::add_cars(*verb, exit_code);
  detect::add_doors(*verb, exit_code);
  detect::add_slots(*verb, exit_code);
}

}  // namespace lapwing::apps
