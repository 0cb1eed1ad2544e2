#include "vision/image/flight.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include "vision/image/internal/exif.hpp"
#include "vision/image/internal/jpeg_segments.hpp"

namespace lapwing::vision {

namespace {

using internal::Bytes;
using internal::Exif;

constexpr double degree = std::numbers::pi / 180.0;

/// Degrees, minutes and seconds, and the letter of the hemisphere.
std::optional<double> angle(Exif const& exif, std::size_t directory, std::uint32_t tag, char negative) {
  auto const degrees = exif.fraction(directory, tag + 1, 0);
  auto const minutes = exif.fraction(directory, tag + 1, 1);
  auto const seconds = exif.fraction(directory, tag + 1, 2);
  auto const side = exif.value(directory, tag);
  if (!degrees || !minutes || !seconds || !side) return std::nullopt;
  double const all = *degrees + *minutes / 60.0 + *seconds / 3600.0;
  return *side == static_cast<std::uint32_t>(negative) ? -all : all;
}

void read_exif(Exif const& exif, FlightRecord& flight) {
  constexpr std::uint32_t camera_tag = 0x8769;
  constexpr std::uint32_t focal_35mm_tag = 0xA405;
  constexpr std::uint32_t gps_tag = 0x8825;
  constexpr std::uint32_t latitude_tag = 1;
  constexpr std::uint32_t longitude_tag = 3;
  constexpr std::uint32_t altitude_tag = 6;
  if (auto const camera = exif.directory_at(camera_tag)) {
    auto const focal = exif.value(*camera, focal_35mm_tag);
    if (focal && *focal >= 4 && *focal <= 2000) flight.focal_35mm = *focal;
  }
  auto const gps = exif.directory_at(gps_tag);
  if (!gps) return;
  auto const latitude = angle(exif, *gps, latitude_tag, 'S');
  auto const longitude = angle(exif, *gps, longitude_tag, 'W');
  if (!latitude || !longitude || std::abs(*latitude) > 90.0 || std::abs(*longitude) > 180.0) return;
  flight.place = geo::Wgs84::from_degrees(*latitude, *longitude, exif.fraction(*gps, altitude_tag).value_or(0.0));
}

/// Of an attribute or an element of that name, whatever its prefix.
std::optional<double> number_in(std::string_view xmp, std::string_view name) {
  for (auto at = xmp.find(name); at != std::string_view::npos; at = xmp.find(name, at + 1)) {
    auto rest = xmp.substr(at + name.size());
    if (at == 0 || xmp[at - 1] != ':') continue;
    if (rest.starts_with("=\"")) {
      rest.remove_prefix(2);
    } else if (rest.starts_with('>')) {
      rest.remove_prefix(1);
    } else {
      continue;
    }
    if (rest.starts_with('+')) rest.remove_prefix(1);
    double value = 0.0;
    auto const [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (error == std::errc() && std::isfinite(value)) return value;
  }
  return std::nullopt;
}

/// The gimbal's word counts more than the flight's, to which it is fixed or not.
void read_xmp(std::string_view xmp, FlightRecord& flight) {
  constexpr double most_height_m = 10'000.0;
  auto const height = number_in(xmp, "RelativeAltitude");
  if (height && *height > 1.0 && *height < most_height_m) flight.height_m = height;
  for (auto const* const name : {"GimbalYawDegree", "Yaw", "FlightYawDegree"}) {
    if (flight.yaw_rad) break;
    if (auto const yaw = number_in(xmp, name)) flight.yaw_rad = geo::wrap_pi(std::fmod(*yaw, 360.0) * degree);
  }
  if (auto const pitch = number_in(xmp, "GimbalPitchDegree")) {
    flight.pitch_rad = std::fmod(*pitch, 360.0) * degree;
  } else if (auto const of_camera = number_in(xmp, "Pitch")) {
    // Of a camera that is fixed to an aircraft and looks down when that is level.
    flight.pitch_rad = (std::fmod(*of_camera, 360.0) - 90.0) * degree;
  }
}

}  // namespace

FlightRecord read_flight(std::span<std::byte const> file) {
  FlightRecord flight;
  if (!internal::says(file, 0, "\xFF\xD8\xFF")) return flight;
  constexpr std::string_view xmp_name("http://ns.adobe.com/xap/1.0/\0", 29);
  for (auto const& [marker, body] : internal::jpeg_segments(file)) {
    if (marker != internal::jpeg_app1) continue;
    if (auto const exif = Exif::of_segment(body)) {
      read_exif(*exif, flight);
    } else if (internal::says(body, 0, xmp_name)) {
      auto const text = body.subspan(xmp_name.size());
      read_xmp({reinterpret_cast<char const*>(text.data()), text.size()}, flight);
    }
  }
  return flight;
}

std::optional<double> metres_a_pixel(FlightRecord const& flight, cv::Size const& picture) {
  if (!flight.height_m || !flight.focal_35mm || picture.empty()) return std::nullopt;
  double const film_diagonal = std::hypot(36.0, 24.0);
  double const diagonal = std::hypot(picture.width, picture.height);
  return *flight.height_m * film_diagonal / (*flight.focal_35mm * diagonal);
}

std::optional<geo::Wgs84> place_of(cv::Point2d const& pixel, cv::Size const& picture, FlightRecord const& flight,
                                   double metres_a_pixel) {
  constexpr double straight_down = -std::numbers::pi / 2.0;
  constexpr double most_tilt = 10.0 * degree;
  if (!flight.place || !flight.yaw_rad) return std::nullopt;
  if (flight.pitch_rad && std::abs(*flight.pitch_rad - straight_down) > most_tilt) return std::nullopt;
  double const right_m = (pixel.x - 0.5 * picture.width) * metres_a_pixel;
  double const ahead_m = (0.5 * picture.height - pixel.y) * metres_a_pixel;
  double const cosine = std::cos(*flight.yaw_rad);
  double const sine = std::sin(*flight.yaw_rad);
  return geo::displaced(*flight.place, {.north = ahead_m * cosine - right_m * sine,
                                        .east = ahead_m * sine + right_m * cosine,
                                        .down = flight.height_m.value_or(0.0)});
}

}  // namespace lapwing::vision
