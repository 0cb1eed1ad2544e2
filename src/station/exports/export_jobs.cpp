#include "station/exports/export_jobs.hpp"

#include <stdlib.h>

#include <algorithm>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "base/text/random_name.hpp"

namespace lapwing::station {

namespace {

namespace files = std::filesystem;

}  // namespace

ExportJobs::ExportJobs(base::Loop& loop, MapExporter& exporter, Limits limits)
    : loop_(loop), exporter_(exporter), limits_(limits) {}

ExportJobs::~ExportJobs() {
  entries_.clear();
  std::error_code ignored;
  if (!folder_.empty()) files::remove_all(folder_, ignored);
}

base::Result<ExportJobs::Job> ExportJobs::start(ExportWish wish, std::string const& extension) {
  tidy_up();
  auto const running = std::ranges::count_if(entries_, [](auto const& one) { return !one.second.job.outcome; });
  if (static_cast<std::size_t>(running) >= limits_.most_running)
    return base::fail(base::ErrorKind::refused, fmt::format("{} exports run already.", running),
                      "Wait until one of them is done, or stop one.");
  if (auto const made = make_folder(); !made) return std::unexpected(made.error());
  auto const seconds = std::chrono::floor<std::chrono::seconds>(loop_.utc_now());
  auto const id = base::random_name(16);  // nobody guesses whose turn is next
  auto& entry = entries_[id];
  entry.job = {.id = id,
               .name = fmt::format("lapwing-{}-{:%Y%m%d-%H%M%S}-{}{}", wish.format,
                                   fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)), ++started_, extension)};
  entry.work = work(entry, std::move(wish));
  entry.work.start();
  return entry.job;
}

base::Task<> ExportJobs::work(Entry& entry, ExportWish wish) {
  auto const file = file_of(entry.job);
  std::function<void(double)> hear = [&entry](double share) {
    entry.job.progress = std::clamp(share, entry.job.progress, 1.0);
  };
  auto writing = exporter_.write(std::move(wish), file, std::move(hear));
  auto const written = co_await std::move(writing);
  std::error_code error;
  auto const bytes = written ? files::file_size(file, error) : 0;
  if (!written) {
    entry.job.outcome = std::unexpected(written.error());
  } else if (error) {
    entry.job.outcome = base::fail(base::ErrorKind::io, "The export left no file behind.");
  } else if (bytes > limits_.most_bytes) {
    entry.job.outcome =
        base::fail(base::ErrorKind::invalid_input, fmt::format("The file would have {} MB.", bytes / 1'000'000),
                   "Choose less of the map, or use `lapwing store export` on the station's computer.");
  } else {
    entry.job.outcome = bytes;
    entry.job.progress = 1.0;
  }
  if (!*entry.job.outcome) files::remove(file, error);
  entry.ended = loop_.now();
}

ExportJobs::Job const* ExportJobs::find(std::string const& id) {
  tidy_up();
  auto const found = entries_.find(id);
  return found == entries_.end() ? nullptr : &found->second.job;
}

bool ExportJobs::drop(std::string const& id) {
  auto const found = entries_.find(id);
  if (found == entries_.end()) return false;
  remove(found);
  return true;
}

base::Result<> ExportJobs::make_folder() {
  std::error_code error;
  if (!folder_.empty() && files::is_directory(folder_, error)) return {};
  auto name = (files::temp_directory_path() / "lapwing-export-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    return base::fail(base::ErrorKind::io,
                      fmt::format("No temporary folder can be made in {}.", files::temp_directory_path().string()),
                      "Is there room? TMPDIR names another place.");
  folder_ = name;
  return {};
}

/// What nobody has fetched for long goes, and the oldest of too many.
void ExportJobs::tidy_up() {
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    bool const is_old = entry->second.job.outcome && loop_.now() - entry->second.ended > limits_.kept_for;
    entry = is_old ? remove(entry) : std::next(entry);
  }
  while (entries_.size() >= limits_.most_kept) {
    auto oldest = entries_.end();
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
      if (!entry->second.job.outcome) continue;
      if (oldest == entries_.end() || entry->second.ended < oldest->second.ended) oldest = entry;
    }
    if (oldest == entries_.end()) return;
    remove(oldest);
  }
}

ExportJobs::Entries::iterator ExportJobs::remove(Entries::iterator entry) {
  auto const file = file_of(entry->second.job);
  auto const next = entries_.erase(entry);  // who writes is stopped first
  std::error_code ignored;
  if (!folder_.empty()) files::remove(file, ignored);
  return next;
}

}  // namespace lapwing::station
