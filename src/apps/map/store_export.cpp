#include "apps/map/store_export.hpp"

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "host/exit_code.hpp"
#include "map/store/care/contents.hpp"

namespace lapwing::apps {

namespace {

namespace care = map::care;
using base::ErrorKind;
using base::fail;

/// Of the work, until the store has been read: how much is in it is not known before.
constexpr double share_of_reading = 0.2;

struct ExportVerb {
  std::string store;
  std::string to;
  std::string format;  ///< empty: by the name of what is written
  std::vector<std::string> layers;
  std::string site;
  std::string floor;
  std::vector<double> within;  ///< west, south, east, north
  double scale = 100.0;
  bool tells_progress = false;
};

base::Result<formats::Format const*> format_for(ExportVerb const& options) {
  auto const* format = options.format.empty() ? formats::format_of(options.to) : formats::format_named(options.format);
  if (format) return format;
  std::vector<std::string_view> names;
  for (auto const& one : formats::formats()) names.push_back(one.name);
  return fail(ErrorKind::invalid_input,
              options.format.empty() ? fmt::format("{} does not say in which format it shall be", options.to)
                                     : fmt::format("there is no format `{}`", options.format),
              fmt::format("--format: {}", fmt::join(names, ", ")));
}

base::Result<std::optional<formats::DegreeBox>> box_of(std::vector<double> const& numbers) {
  if (numbers.empty()) return std::optional<formats::DegreeBox>();
  formats::DegreeBox const box{numbers[0], numbers[1], numbers[2], numbers[3]};
  bool const is_on_earth = std::abs(box.west) <= 180.0 && std::abs(box.east) <= 180.0 && box.south >= -90.0 &&
                           box.north <= 90.0 && box.south <= box.north;
  if (!is_on_earth)
    return fail(ErrorKind::invalid_input, "--within is no part of the globe",
                "west,south,east,north in degrees: 8.54,47.39,8.56,47.40");
  return std::optional(box);
}

base::Result<formats::Choice> choice_of(ExportVerb const& options) {
  formats::Choice choice{.site = options.site, .floor = options.floor};
  for (auto const& name : options.layers) {
    auto const layer = layer_called(name);
    if (!layer) return std::unexpected(layer.error());
    choice.layers.push_back(*layer);
  }
  auto const within = box_of(options.within);
  if (!within) return std::unexpected(within.error());
  choice.within = *within;
  return choice;
}

base::Result<> export_store(ExportVerb const& options) {
  auto choice = choice_of(options);
  if (!choice) return std::unexpected(choice.error());
  auto const format = format_for(options);
  if (!format) return std::unexpected(format.error());
  auto const tell = [&options](double share) {
    if (options.tells_progress) {
      fmt::print("progress {:.3f}\n", share);
      std::fflush(stdout);
    }
    return true;
  };
  tell(0.0);
  auto contents = care::read_contents(options.store);
  if (!contents) return std::unexpected(contents.error());
  tell(share_of_reading);
  formats::MapContents const all{std::move(contents->sites), std::move(contents->features), std::move(contents->grids)};
  formats::ExportOptions wanted{.choice = *std::move(choice), .scale = options.scale};
  wanted.blob = [&options](std::string const& hash) { return care::read_picture(options.store, hash); };
  wanted.progress = [&tell](double share) { return tell(share_of_reading + share * (1.0 - share_of_reading)); };
  return formats::export_map(all, **format, options.to, wanted);
}

int write_out(ExportVerb const& options) {
  if (auto const written = export_store(options); !written) return host::refuse(written.error());
  fmt::print("{}\n", options.to);
  return host::exit_done;
}

int list_formats(bool as_json) {
  auto list = nlohmann::json::array();
  for (auto const& format : formats::formats()) {
    bool const is_packed = formats::is_folder(format);
    if (!as_json) fmt::print("{:<12}{:<8}{}\n", format.name, is_packed ? "folder" : format.extension, format.note);
    list.push_back({{"name", format.name},
                    {"extension", is_packed ? ".zip" : format.extension},
                    {"features", format.holds_features},
                    {"grids", format.holds_grids},
                    {"pictures", format.holds_pictures},
                    {"note", format.note}});
  }
  if (as_json) fmt::print("{}\n", list.dump());
  return host::exit_done;
}

}  // namespace

base::Result<map::LayerKind> layer_called(std::string const& name) {
  if (auto const layer = map::layer_named(name)) return *layer;
  std::vector<std::string_view> names;
  for (auto const layer : map::all_layers) names.push_back(map::name_of(layer));
  return fail(ErrorKind::invalid_input, fmt::format("there is no layer `{}`", name),
              fmt::format("layers: {}", fmt::join(names, ", ")));
}

void add_export(CLI::App& store, int& exit_code) {
  auto const options = std::make_shared<ExportVerb>();
  auto* const verb = store.add_subcommand("export", "Write the map as a file of another program");
  verb->add_option("store", options->store, "A folder, or postgresql://USER@HOST/DATABASE")->required();
  verb->add_option("--to", options->to, "The file or folder; what would be a folder can be a .zip")->required();
  verb->add_option("--format", options->format,
                   "geopackage, geojson, kml, kmz, csv, geotiff, ros, svg or pdf; default: by the name");
  verb->add_option("--layer", options->layers, "This layer alone; again for further ones")->allow_extra_args(false);
  verb->add_option("--site", options->site, "This site alone");
  verb->add_option("--floor", options->floor, "This floor alone");
  constexpr int corners = 4;
  verb->add_option("--within", options->within, "WEST,SOUTH,EAST,NORTH in degrees: what lies there at least in part")
      ->delimiter(',')
      ->expected(corners)
      ->allow_extra_args(false);
  verb->add_option("--scale", options->scale, "Of prints: 100 is 1 cm for a metre")->capture_default_str();
  verb->add_flag("--progress", options->tells_progress, "Tell how far it is, for programs: a line `progress 0.25`");
  verb->callback([options, &exit_code] { exit_code = write_out(*options); });
}

void add_formats(CLI::App& store, int& exit_code) {
  auto const as_json = std::make_shared<bool>(false);
  auto* const verb = store.add_subcommand("formats", "What a map can be exported as");
  verb->add_flag("--json", *as_json, "For programs");
  verb->callback([as_json, &exit_code] { exit_code = list_formats(*as_json); });
}

}  // namespace lapwing::apps
