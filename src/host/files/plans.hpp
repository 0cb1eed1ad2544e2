#pragma once

#include <string>

#include "missions/plan_library.hpp"

namespace lapwing::host {

/// For --plans of every verb that has it.
inline constexpr auto plans_help =
    "Directory of .plan and .waypoints files; a script names them without the ending: task('north')";

struct LoadedPlans {
  missions::PlanLibrary library;
  std::vector<std::string> notes;     ///< what of the files is not flown
  std::vector<base::Error> mistakes;  ///< of files that cannot be read
};

/// The plan files (`.plan`, `.waypoints`) of a directory, not of those below it, under their names without the ending.
/// A file that is wrong is among the mistakes, and in the library as its error: it matters when a script wants it.
/// Errors: the directory cannot be read, holds too many plans, or two of one name. An empty `directory` is no library.
[[nodiscard]] base::Result<LoadedPlans> load_plans(std::string const& directory);

}  // namespace lapwing::host
