#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

#include "apps/verb.hpp"
#include "formats/base_map.hpp"

namespace lapwing::apps {

namespace {

struct BasemapOptions {
  std::filesystem::path picture;
  std::filesystem::path out;
};

/// On a terminal one line that changes; elsewhere nothing until the end.
bool show(double share) {
  if (isatty(STDERR_FILENO) != 0) fmt::print(stderr, "\r{:3.0f} %", share * 100.0);
  return true;
}

int basemap(BasemapOptions const& options) {
  auto out = options.out;
  if (out.empty()) out = std::filesystem::path(options.picture).replace_extension(".mbtiles");
  auto const made = formats::write_base_map(options.picture, out, show);
  if (isatty(STDERR_FILENO) != 0) fmt::print(stderr, "\r\033[K");
  if (!made) return host::refuse(made.error());
  fmt::print("{}\n", out.string());
  fmt::print(stderr, "to show it, in the station's configuration:\n\n    [[map.base]]\n    file = \"{}\"\n\n",
             out.string());
  return host::exit_done;
}

}  // namespace

void add_basemap(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<BasemapOptions>();
  auto* verb = begin_verb(program, "basemap");
  verb->add_option("picture", options->picture, "GeoTIFF, JPEG 2000, or JPEG or PNG with a world file")
      ->required()
      ->check(CLI::ExistingFile);
  verb->add_option("--out", options->out, "The archive; default: the picture's name with .mbtiles");
  verb->callback([options, &exit_code] { exit_code = basemap(*options); });
}

}  // namespace lapwing::apps
