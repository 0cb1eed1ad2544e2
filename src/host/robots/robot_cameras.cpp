#include "host/robots/robot_cameras.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/config.hpp"
#include "host/files/config_file.hpp"

namespace lapwing::host {

namespace {

namespace fs = std::filesystem;
using base::ConfigReader;
using base::Diagnostics;
using base::config_kinds::invalid_value;

constexpr double degree = std::numbers::pi / 180.0;
constexpr std::array<std::string_view, 4> schemes{"rtsp://", "rtsps://", "http://", "https://"};

/// The library that opens addresses knows many more ways, some of which read any file or join several sources.
void read_source(Diagnostics& diagnostics, base::Placed<std::string> const& text, fs::path const& beside,
                 RobotCamera& camera) {
  camera.kind = RobotCamera::Kind::source;
  if (!text.value.contains("://")) {
    camera.from = (beside / text.value).string();
    return;
  }
  camera.from = text.value;
  if (std::ranges::none_of(schemes, [&](auto scheme) { return text.value.starts_with(scheme); }))
    diagnostics.report(invalid_value, text.span, "a camera's pictures do not come that way",
                       fmt::format("an address begins with {}", fmt::join(schemes, ", ")));
}

void read_from(ConfigReader& table, base::Span span, fs::path const& beside, RobotCamera& camera) {
  auto const source = table.text("source");
  auto const folder = table.text("folder");
  auto const topic = table.text("topic");
  if (source) read_source(table.diagnostics(), *source, beside, camera);
  if (folder) {
    camera.kind = RobotCamera::Kind::folder;
    camera.from = (beside / folder->value).string();
  }
  if (topic) {
    camera.kind = RobotCamera::Kind::topic;
    camera.from = topic->value;
  }
  int const named = static_cast<int>(table.has("source")) + static_cast<int>(table.has("folder")) +
                    static_cast<int>(table.has("topic"));
  if (named != 1)
    table.diagnostics().report(
        invalid_value, span,
        named == 0 ? "nothing says where the camera's pictures come from"
                   : "the camera's pictures come from two places",
        "source = \"/dev/video0\" or an address, folder = \"pictures\", or topic = \"/robot1/image_raw\"");
}

void read_mount(ConfigReader& table, robot::CameraMount& mount) {
  constexpr std::int64_t least_px = 16;
  constexpr std::int64_t most_px = 8'192;
  constexpr double furthest_m = 3.0;
  if (auto const width = table.integer("width", least_px, most_px)) mount.width_px = static_cast<int>(width->value);
  if (auto const height = table.integer("height", least_px, most_px)) mount.height_px = static_cast<int>(height->value);
  if (auto const view = table.number("view_deg", 1.0, 150.0)) mount.view_rad = view->value * degree;
  if (auto const at = table.numbers("at", 3, -furthest_m, furthest_m)) {
    mount.x_m = at->value[0];
    mount.y_m = at->value[1];
    mount.up_m = at->value[2];
  }
  if (auto const yaw = table.number("yaw_deg", -360.0, 360.0)) mount.yaw_rad = yaw->value * degree;
  if (auto const pitch = table.number("pitch_deg", -90.0, 90.0)) mount.pitch_rad = pitch->value * degree;
}

/// Where none is named, the one that looks ahead most.
void choose_photographers(std::vector<RobotCamera>& cameras) {
  for (auto const& any : std::vector(cameras)) {
    auto const is_of_it = [&](RobotCamera const& camera) { return camera.robot == any.robot; };
    if (std::ranges::any_of(cameras, [&](auto const& camera) { return is_of_it(camera) && camera.photographs; }))
      continue;
    RobotCamera* ahead = nullptr;
    for (auto& camera : cameras)
      if (is_of_it(camera) && (!ahead || std::cos(camera.mount.yaw_rad) > std::cos(ahead->mount.yaw_rad)))
        ahead = &camera;
    ahead->photographs = true;
  }
}

}  // namespace

std::vector<RobotCamera> read_robot_cameras(base::SourceFile const& source, Diagnostics& diagnostics) {
  std::vector<RobotCamera> cameras;
  auto const entries = base::parse_config(source, diagnostics);
  if (diagnostics.has_errors()) return cameras;
  ConfigReader root(entries, diagnostics);
  auto const beside = fs::path(source.name()).parent_path();
  for (auto& [table, span] : root.tables("camera")) {
    RobotCamera camera;
    if (auto const robot = table.text("robot")) camera.robot = robot->value;
    read_from(table, span, beside, camera);
    read_mount(table, camera.mount);
    if (auto const photographs = table.flag("photographs")) camera.photographs = photographs->value;
    table.refuse_unknown();
    cameras.push_back(std::move(camera));
  }
  root.refuse_unknown();
  choose_photographers(cameras);
  return cameras;
}

base::Result<std::vector<RobotCamera>> load_robot_cameras(std::string const& file) {
  if (file.empty()) return std::vector<RobotCamera>();
  return load_config(file, read_robot_cameras, "docs/guide/robots.md");
}

}  // namespace lapwing::host
