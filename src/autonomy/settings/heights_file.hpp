#pragma once

#include <string>

#include "autonomy/interface/heights.hpp"
#include "autonomy/settings/folder.hpp"

namespace lapwing::autonomy {

/// Hover heights over boots: the file in force, and the one before it, for when that turns out damaged. Whenever the
/// power goes while new heights are saved, the next boot has either the old or the new ones.
inline constexpr std::string_view heights_file = "hover-heights.toml";
inline constexpr std::string_view heights_file_before = "hover-heights.before.toml";

struct LoadedHeights {
  HoverHeights heights = {};  ///< the defaults when no file is sound
  std::string warning = {};   ///< for the operator: what was wrong with a file; empty when nothing was
};
[[nodiscard]] LoadedHeights load_heights(Folder& folder);

/// Heights that are in force on the disk when it returns. Error (io): the disk says no; what was in force stays so.
[[nodiscard]] base::Result<> save_heights(Folder& folder, HoverHeights const& heights);

}  // namespace lapwing::autonomy
