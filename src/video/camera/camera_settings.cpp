#include "video/camera/camera_settings.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include <fmt/format.h>

#include "video/camera/video_camera.hpp"

namespace lapwing::video {

namespace {

using base::ConfigReader;
using base::config_kinds::invalid_value;

constexpr double degree = std::numbers::pi / 180.0;

CameraSettings::Kind kind_of(ConfigReader& table) {
  auto const word = table.text("kind");
  if (word && word->value == "folder") return CameraSettings::Kind::folder;
  if (word && word->value == "pattern") return CameraSettings::Kind::pattern;
  if (word && word->value == "video") return CameraSettings::Kind::video;
  if (word && word->value != "simulated")
    table.diagnostics().report(invalid_value, word->span, "there is no such kind of camera",
                               "it can be simulated, video, folder, pattern");
  return CameraSettings::Kind::simulated;
}

geo::Lens lens_of(ConfigReader& table) {
  constexpr std::int64_t least_px = 16;
  constexpr std::int64_t most_px = 8'192;
  auto const width = table.integer("width", least_px, most_px);
  auto const height = table.integer("height", least_px, most_px);
  auto const across = table.number("view_deg", 1.0, 150.0);
  constexpr double usual_deg = 62.0;
  auto lens =
      geo::pinhole(width ? static_cast<int>(width->value) : 1280, height ? static_cast<int>(height->value) : 720,
                   (across ? across->value : usual_deg) * degree);
  constexpr double largest_px = 1e6;
  if (auto const focal = table.numbers("focal_px", 2, 1.0, largest_px)) {
    if (across)
      table.diagnostics().report(invalid_value, focal->span, "the lens has both view_deg and focal_px",
                                 "leave one out");
    lens.focal_x_px = focal->value[0];
    lens.focal_y_px = focal->value[1];
  }
  constexpr double half_px = 0.5;  // OpenCV counts from the middle of the first pixel
  if (auto const middle = table.numbers("middle_px", 2, -largest_px, largest_px))
    lens.middle = {middle->value[0] + half_px, middle->value[1] + half_px};
  if (auto const bent = table.numbers("distortion", 5, -100.0, 100.0)) {
    auto const& d = bent->value;
    lens.k1 = d[0];
    lens.k2 = d[1];
    lens.p1 = d[2];
    lens.p2 = d[3];
    lens.k3 = d[4];
  }
  return lens;
}

Mount mount_of(ConfigReader& table) {
  Mount mount;
  auto part = table.table("mount");
  if (!part) return mount;
  if (auto const at = part->numbers("at", 3, -10.0, 10.0))
    mount.at = geo::Vector3<BodyFrame>(at->value[0], at->value[1], at->value[2]);
  if (auto const yaw = part->number("yaw_deg", -360.0, 360.0)) mount.yaw_rad = yaw->value * degree;
  if (auto const tilt = part->number("tilt_deg", -90.0, 90.0)) mount.tilt_rad = tilt->value * degree;
  if (auto const gimbal = part->flag("gimbal")) mount.has_gimbal = gimbal->value;
  part->refuse_unknown();
  return mount;
}

CameraFaults faults_of(ConfigReader& table) {
  CameraFaults faults;
  auto part = table.table("faults");
  if (!part) return faults;
  auto const number = [&](std::string_view key, double high, double& into) {
    if (auto const value = part->number(key, 0.0, high)) into = value->value;
  };
  number("noise", 30.0, faults.noise);
  number("blur_px", 20.0, faults.blur_px);
  number("position_m", 50.0, faults.position_m);
  double angle_deg = 0.0;
  number("angle_deg", 45.0, angle_deg);
  faults.angle_rad = angle_deg * degree;
  double delay_s = 0.0;
  number("delay_s", 10.0, delay_s);
  faults.delay = base::from_seconds(delay_s);
  number("missing_share", 1.0, faults.missing_share);
  part->refuse_unknown();
  return faults;
}

void report_if_missing(ConfigReader& table, std::string_view key, bool is_needed) {
  if (is_needed && !table.has(key))
    table.diagnostics().report(invalid_value, {0, 1}, "the camera needs " + std::string(key),
                               std::string(key) + " = \"...\" in its table");
}

std::filesystem::path path_of(ConfigReader& table, std::string_view key, bool is_needed,
                              std::filesystem::path const& beside) {
  auto const text = table.text(key);
  if (text) return beside / text->value;
  report_if_missing(table, key, is_needed);
  return {};
}

/// The library that opens addresses knows many more ways, some of which read any file or join several sources.
std::string source_of(ConfigReader& table, bool is_needed, std::filesystem::path const& beside) {
  constexpr std::array<std::string_view, 4> schemes = {"rtsp://", "rtsps://", "http://", "https://"};
  auto const text = table.text("source");
  report_if_missing(table, "source", is_needed);
  if (!text) return {};
  if (!is_address(text->value)) return (beside / text->value).string();
  if (std::ranges::none_of(schemes, [&](auto scheme) { return text->value.starts_with(scheme); }))
    table.diagnostics().report(invalid_value, text->span, "a camera's pictures do not come that way",
                               fmt::format("an address begins with {}", fmt::join(schemes, ", ")));
  return text->value;
}

}  // namespace

CameraSettings read_camera(ConfigReader& table, std::filesystem::path const& beside) {
  CameraSettings settings;
  settings.kind = kind_of(table);
  settings.lens = lens_of(table);
  settings.mount = mount_of(table);
  settings.world = path_of(table, "world", settings.kind == CameraSettings::Kind::simulated, beside);
  settings.folder = path_of(table, "folder", settings.kind == CameraSettings::Kind::folder, beside);
  settings.source = source_of(table, settings.kind == CameraSettings::Kind::video, beside);
  if (auto const seed = table.integer("seed", 0, std::numeric_limits<std::int64_t>::max()))
    settings.seed = static_cast<std::uint64_t>(seed->value);
  settings.faults = faults_of(table);
  table.refuse_unknown();
  if (auto const fault = geo::lens_fault(settings.lens))
    table.diagnostics().report(invalid_value, {0, 1}, "the camera has no sound lens: " + *fault);
  return settings;
}

}  // namespace lapwing::video
