#include "host/map/map_exports.hpp"

#include <charconv>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/async/child_program.hpp"

namespace lapwing::host {

namespace {

using station::ExportFormat;
using station::ExportWish;

constexpr std::chrono::seconds longest_answer{20};
constexpr std::chrono::seconds longest_work{300};

/// `lapwing: message` and `  hint` of another of our programs, as it printed them.
base::Error told_by(std::string_view errors) {
  auto const next_line = [&errors] {
    auto const end = errors.find('\n');
    auto line = errors.substr(0, end);
    errors.remove_prefix(end == std::string_view::npos ? errors.size() : end + 1);
    auto const begin = line.find_first_not_of(' ');
    return std::string(begin == std::string_view::npos ? "" : line.substr(begin));
  };
  auto message = next_line();
  for (std::string_view const prefix : {"lapwing: ", "error: "})
    if (message.starts_with(prefix)) message.erase(0, prefix.size());
  return {.kind = base::ErrorKind::invalid_input, .message = std::move(message), .hint = next_line()};
}

base::Error without_program(base::Error const& error) {
  return {.kind = base::ErrorKind::not_found,
          .message = fmt::format("Files of other programs cannot be written here: {}.", error.message),
          .hint = "It is built where GDAL is installed; docs/guide/deployment.md says how."};
}

std::vector<ExportFormat> formats_in(std::string_view text) {
  std::vector<ExportFormat> formats;
  auto const list = nlohmann::json::parse(text, nullptr, false);
  if (!list.is_array()) return formats;
  for (auto const& one : list)
    formats.push_back({.name = one.value("name", ""),
                       .extension = one.value("extension", ""),
                       .holds_features = one.value("features", false),
                       .holds_grids = one.value("grids", false),
                       .holds_pictures = one.value("pictures", false),
                       .note = one.value("note", "")});
  return formats;
}

/// A word that begins with a dash is no option there, whatever a site is called.
std::string option(std::string_view name, std::string_view value) {
  return fmt::format("--{}={}", name, value);
}

std::vector<std::string> words_for(std::string const& address, ExportWish const& wish,
                                   std::filesystem::path const& file) {
  std::vector<std::string> words{"store",
                                 "export",
                                 address,
                                 option("to", file.string()),
                                 option("format", wish.format),
                                 "--progress",
                                 fmt::format("--scale={}", wish.scale)};
  for (auto const& layer : wish.layers) words.push_back(option("layer", layer));
  if (!wish.site.empty()) words.push_back(option("site", wish.site));
  if (!wish.floor.empty()) words.push_back(option("floor", wish.floor));
  if (wish.within_deg) {
    auto const& [west, south, east, north] = *wish.within_deg;
    words.push_back(fmt::format("--within={},{},{},{}", west, south, east, north));
  }
  return words;
}

}  // namespace

std::filesystem::path MapExports::usual_program() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / "lapwing-map";
}

base::Task<base::Result<std::vector<ExportFormat>>> MapExports::formats() {
  if (!formats_.empty()) co_return formats_;
  std::string text;
  base::ChildProgram program{.program = program_, .words = {"store", "formats", "--json"}, .longest = longest_answer};
  std::function<void(std::string_view)> hear = [&text](std::string_view line) { text = line; };
  auto work = base::run_child(loop_, std::move(program), std::move(hear));
  auto const told = co_await std::move(work);
  if (!told) co_return std::unexpected(without_program(told.error()));
  formats_ = formats_in(text);
  if (formats_.empty())
    co_return std::unexpected(without_program(
        {.kind = base::ErrorKind::io, .message = fmt::format("{} ends with {}", program_.string(), told->exit_code)}));
  co_return formats_;
}

base::Task<base::Result<>> MapExports::write(ExportWish wish, std::filesystem::path file,
                                             std::function<void(double)> progress) {
  // What a viewer has been shown is to be in the file, and the other process sees what has been committed.
  if (auto const kept = co_await store_.flush(); !kept) co_return std::unexpected(kept.error());
  base::ChildProgram program{.program = program_, .words = words_for(address_, wish, file), .longest = longest_work};
  std::function<void(std::string_view)> hear = [progress = std::move(progress)](std::string_view line) {
    constexpr std::string_view word = "progress ";
    if (!line.starts_with(word)) return;
    double share = 0.0;
    auto const [end, error] = std::from_chars(line.data() + word.size(), line.data() + line.size(), share);
    if (error == std::errc{}) progress(share);
  };
  auto work = base::run_child(loop_, std::move(program), std::move(hear));
  auto const done = co_await std::move(work);
  if (!done) co_return std::unexpected(done.error());
  if (done->exit_code == 0) co_return base::Result<>();
  if (!done->errors.empty()) co_return std::unexpected(told_by(done->errors));
  co_return base::fail(base::ErrorKind::io, fmt::format("The export was cut off ({}).", done->exit_code),
                       "It may be too large for this computer: choose less of the map.");
}

}  // namespace lapwing::host
