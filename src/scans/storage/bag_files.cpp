#include "scans/storage/bag_files.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "scans/storage/mcap.hpp"
#include "scans/storage/sqlite_bag.hpp"
#include "scans/storage/unpack.hpp"

namespace lapwing::scans {

namespace fs = std::filesystem;

namespace {

using base::ErrorKind;
using base::fail;

constexpr std::size_t most_files = 10'000;

std::string beginning_of(fs::path const& file) {
  std::string bytes(16, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\"'";
  auto const first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// The items of the list `relative_file_paths`, which is all that is needed of the file. Every version of rosbag2
/// writes one a line.
std::vector<std::string> listed_files(fs::path const& metadata) {
  constexpr std::size_t longest_line = 10'000;
  std::vector<std::string> names;
  std::ifstream file(metadata);
  bool is_list = false;
  for (std::string line; std::getline(file, line) && line.size() < longest_line && names.size() < most_files;) {
    auto const words = trimmed(line);
    if (is_list && words.starts_with('-')) {
      names.emplace_back(trimmed(words.substr(1)));
    } else if (is_list && !words.empty()) {
      break;
    } else if (words == "relative_file_paths:") {
      is_list = true;
    }
  }
  return names;
}

std::vector<fs::path> storage_files(fs::path const& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end && files.size() < most_files;
       entry.increment(error)) {
    auto const extension = entry->path().extension();
    if (extension == ".db3" || extension == ".mcap") files.push_back(entry->path());
  }
  std::ranges::sort(files);
  return files;
}

base::Result<std::vector<fs::path>> files_of_folder(fs::path const& folder) {
  std::vector<fs::path> files;
  // Older versions put the folder's name before the file's.
  for (auto const& name : listed_files(folder / "metadata.yaml")) files.push_back(folder / fs::path(name).filename());
  for (auto const& file : files)
    if (!fs::exists(file))
      return fail(ErrorKind::not_found,
                  fmt::format("metadata.yaml names {}, which is not there", file.filename().string()),
                  "give the file that is there instead of the folder");
  if (!files.empty()) return files;
  files = storage_files(folder);
  if (files.empty())
    return fail(ErrorKind::invalid_input, "a folder without a bag: no metadata.yaml, and no .db3 or .mcap");
  if (files.size() > 1)
    return fail(ErrorKind::invalid_input,
                fmt::format("{} bags and no metadata.yaml that says which belong together", files.size()),
                fmt::format("give one of them: {}", files.front().string()));
  return files;
}

}  // namespace

bool is_bag(fs::path const& path) {
  if (fs::is_directory(path)) return true;
  auto const beginning = beginning_of(path);
  return is_mcap(beginning) || is_sqlite(beginning) || is_zstd(beginning) || beginning.starts_with("#ROSBAG");
}

base::Result<std::vector<fs::path>> bag_files(fs::path const& path) {
  if (fs::is_directory(path)) return files_of_folder(path);
  return std::vector{path};
}

base::Result<BagRemark> read_bag_file(fs::path const& file, BagListener& listener) {
  auto const beginning = beginning_of(file);
  if (is_sqlite(beginning)) return read_sqlite_bag(file, listener);
  if (is_zstd(beginning)) return fail(ErrorKind::invalid_input, "packed as a whole", "unpack it: unzstd FILE");
  if (beginning.starts_with("#ROSBAG"))
    return fail(ErrorKind::invalid_input, "a bag of ROS 1", "convert it: rosbags-convert --src FILE --dst FOLDER");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return fail(ErrorKind::io, "cannot be opened");
  return read_mcap(stream, listener);
}

}  // namespace lapwing::scans
