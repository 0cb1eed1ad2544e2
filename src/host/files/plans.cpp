#include "host/files/plans.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "host/files/files.hpp"
#include "plan/files/plan_file.hpp"

namespace lapwing::host {

namespace {

namespace fs = std::filesystem;
using base::ErrorKind;

constexpr std::size_t most_plans = 10'000;

base::Result<std::vector<fs::path>> plan_files(std::string const& directory) {
  std::error_code error;
  std::vector<fs::path> files;
  for (auto entry = fs::directory_iterator(directory, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    auto const ending = entry->path().extension();
    if (ending == ".plan" || ending == ".waypoints") files.push_back(entry->path());
    if (files.size() > most_plans)
      return base::fail(ErrorKind::invalid_input, fmt::format("{}: more than {} plans", directory, most_plans));
  }
  if (error)
    return base::fail(ErrorKind::not_found, fmt::format("--plans {}: {}", directory, error.message()),
                      "name a directory that holds .plan or .waypoints files");
  std::ranges::sort(files);
  return files;
}

base::Result<plan::Plan> read(fs::path const& path) {
  auto const text = read_script(path.string());
  if (!text) return std::unexpected(text.error());
  auto read = plan::read_plan(path.string(), *text);
  if (!read) return std::unexpected(read.error());
  if (auto const flown = plan::mission_to_fly(path.string(), read->plan); !flown) return std::unexpected(flown.error());
  return std::move(read->plan);
}

/// A script flies the mission alone.
std::vector<std::string> notes_on(plan::Plan const& plan) {
  std::vector<std::string> notes;
  auto const zones = plan.fence.zones.size();
  if (zones > 0) notes.push_back(fmt::format("its geofence ({} polygons and circles) is not uploaded", zones));
  if (!plan.rally.empty()) notes.push_back(fmt::format("its {} rally points are not uploaded", plan.rally.size()));
  return notes;
}

}  // namespace

base::Result<LoadedPlans> load_plans(std::string const& directory) {
  LoadedPlans plans;
  if (directory.empty()) return plans;
  auto const files = plan_files(directory);
  if (!files) return std::unexpected(files.error());
  for (auto const& path : *files) {
    auto const name = plan::plan_name(path.string());
    if (plans.library.contains(name))
      return base::fail(ErrorKind::invalid_input,
                        fmt::format("{}: another plan is called '{}' too", path.string(), name),
                        "rename one of the files");
    auto plan = read(path);
    if (!plan) {
      plans.mistakes.push_back(plan.error());
      plans.library.emplace(name, std::unexpected(plan.error()));
      continue;
    }
    for (auto const& note : notes_on(*plan)) plans.notes.push_back(fmt::format("{}: {}", path.string(), note));
    plans.library.emplace(name, std::move(plan->mission));
  }
  return plans;
}

}  // namespace lapwing::host
