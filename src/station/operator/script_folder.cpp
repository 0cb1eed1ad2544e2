#include "station/operator/script_folder.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

namespace lapwing::station {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_scripts = 1000;
constexpr std::uintmax_t largest_script = 1u << 20;  // what `start_script` takes, too

bool is_script_name(std::string_view name) {
  return name.ends_with(".dolphin") && !name.starts_with('.') &&
         name.find_first_of(std::string_view("/\\\0", 3)) == std::string_view::npos;
}

}  // namespace

std::vector<std::string> list_scripts(fs::path const& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    std::error_code unreadable;
    auto name = entry->path().filename().string();
    if (is_script_name(name) && entry->is_regular_file(unreadable)) names.push_back(std::move(name));
  }
  std::ranges::sort(names);
  if (names.size() > most_scripts) names.resize(most_scripts);
  return names;
}

base::Result<std::string> read_script(fs::path const& folder, std::string_view name) {
  if (!is_script_name(name)) {
    return base::fail(base::ErrorKind::invalid_input, fmt::format("'{}' is no name of a script.", name),
                      "Give a name from /api/v1/scripts.");
  }
  std::error_code error;
  auto const root = fs::canonical(folder, error);
  auto const file = error ? fs::path() : fs::canonical(root / name, error);
  if (error || file.parent_path() != root || !fs::is_regular_file(file, error)) {
    return base::fail(base::ErrorKind::not_found, fmt::format("There is no script {}.", name));
  }
  if (auto const size = fs::file_size(file, error); error || size > largest_script) {
    return base::fail(base::ErrorKind::invalid_input, fmt::format("{} is too large for a script.", name));
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return base::fail(base::ErrorKind::io, fmt::format("{} cannot be read.", name));
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

}  // namespace lapwing::station
