#include "autonomy/settings/heights_file.hpp"

#include <fmt/format.h>

#include "autonomy/settings/heights_text.hpp"

namespace lapwing::autonomy {

namespace {

std::string const in_force(heights_file);
std::string const before(heights_file_before);
std::string const fresh = in_force + ".part";

/// Error: not_found, or what is wrong with it.
base::Result<HoverHeights> read_heights(Folder& folder, std::string const& name) {
  auto const text = folder.read(name, longest_settings + 1);
  if (!text) return std::unexpected(text.error());
  if (!*text) return base::fail(base::ErrorKind::not_found, fmt::format("{}: there is none", name));
  return parse_heights(name, **text);
}

}  // namespace

LoadedHeights load_heights(Folder& folder) {
  auto const now = read_heights(folder, in_force);
  if (now) return {*now};
  bool const is_missing = now.error().kind == base::ErrorKind::not_found;
  auto const earlier = read_heights(folder, before);
  if (earlier) {
    // Between its two renames the power went: the old ones are in force, and nothing was wrong with them.
    if (is_missing) return {*earlier};
    return {*earlier, fmt::format("{}; the heights before are in force", now.error().message)};
  }
  if (is_missing && earlier.error().kind == base::ErrorKind::not_found) return {};
  return {
      {},
      fmt::format("{}; the heights are the usual ones", is_missing ? earlier.error().message : now.error().message)};
}

base::Result<> save_heights(Folder& folder, HoverHeights const& heights) {
  if (auto written = folder.write_through(fresh, to_text(heights)); !written) return written;
  // A damaged file must not take the place of a sound one.
  if (read_heights(folder, in_force))
    if (auto kept = folder.rename(in_force, before); !kept) return kept;
  if (auto renamed = folder.rename(fresh, in_force); !renamed) return renamed;
  return folder.sync_names();
}

}  // namespace lapwing::autonomy
