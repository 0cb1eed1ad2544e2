#include "apps/slam/recorded_log.hpp"

#include <fstream>
#include <utility>

#include <fmt/format.h>

#include "scans/bag_log.hpp"
#include "slam/readers/any_log.hpp"

namespace lapwing::apps {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_log_bytes = 4ULL << 30;

}  // namespace

base::Result<std::string> read_file(fs::path const& path) {
  std::error_code error;
  auto const size = fs::file_size(path, error);
  if (error) return base::fail(base::ErrorKind::io, fmt::format("{}: {}", path.string(), error.message()));
  if (size > most_log_bytes)
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("{}: more than {} GB", path.string(), most_log_bytes >> 30));
  std::ifstream file(path, std::ios::binary);
  std::string text(size, '\0');
  if (!file.read(text.data(), static_cast<std::streamsize>(size)))
    return base::fail(base::ErrorKind::io, fmt::format("{}: cannot be read", path.string()));
  return text;
}

std::unexpected<base::Error> in_file(fs::path const& path, base::Error error) {
  error.message = fmt::format("{}: {}", path.string(), error.message);
  return std::unexpected(std::move(error));
}

base::Result<std::vector<slam::Relation>> read_relations(fs::path const& path) {
  if (path.empty()) return std::vector<slam::Relation>();
  auto text = read_file(path);
  if (!text) return std::unexpected(text.error());
  auto relations = slam::read_relations(*text);
  if (!relations) return in_file(path, relations.error());
  return relations;
}

base::Result<RecordedLog> read_text_log(fs::path const& path, std::string text) {
  auto log = slam::read_log(text);
  if (!log) return in_file(path, log.error());
  return RecordedLog{.log = *std::move(log)};
}

base::Result<RecordedLog> read_bag_log(fs::path const& path, scans::BagChoice const& choice) {
  auto bag = scans::read_bag(path, choice);
  if (!bag) return in_file(path, bag.error());
  return RecordedLog{.log = std::move(bag->log),
                     .scan_topic = std::move(bag->scan_topic),
                     .odometry = std::move(bag->odometry),
                     .remarks = std::move(bag->remarks)};
}

}  // namespace lapwing::apps
