#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "base/async/loop.hpp"
#include "base/async/task.hpp"
#include "base/error.hpp"
#include "base/time.hpp"
#include "station/exports/map_exporter.hpp"

namespace lapwing::station {

/// Exports that run, and files that wait to be fetched: a few of either, and none for long.
class ExportJobs {
 public:
  struct Limits {
    std::size_t most_running = 2;
    std::size_t most_kept = 6;  ///< the oldest finished ones go
    base::Duration kept_for = std::chrono::minutes(10);
    std::uintmax_t most_bytes = std::uintmax_t{128} * 1024 * 1024;
  };
  struct Job {
    std::string id;
    std::string name;  ///< of the file, for who saves it
    double progress = 0.0;
    std::optional<base::Result<std::uintmax_t>> outcome = {};  ///< the size of the file, or why there is none
  };

  /// Loop and exporter outlive it.
  ExportJobs(base::Loop& loop, MapExporter& exporter, Limits limits);
  ExportJobs(base::Loop& loop, MapExporter& exporter) : ExportJobs(loop, exporter, Limits{}) {}
  ExportJobs(ExportJobs const&) = delete;
  ExportJobs& operator=(ExportJobs const&) = delete;
  ~ExportJobs();

  [[nodiscard]] MapExporter& exporter() { return exporter_; }
  /// Errors: refused while as many run as may; io without a place for the file.
  [[nodiscard]] base::Result<Job> start(ExportWish wish, std::string const& extension);
  /// Null: there is none of that id any more. Valid until the next turn of the loop.
  [[nodiscard]] Job const* find(std::string const& id);
  /// Of a job that has one.
  [[nodiscard]] std::filesystem::path file_of(Job const& job) const { return folder_ / job.name; }
  /// Stops it, and takes its file away. False: there was none.
  bool drop(std::string const& id);

 private:
  struct Entry {
    Job job;
    base::TimePoint ended{};
    base::Task<> work = {};
  };
  using Entries = std::map<std::string, Entry>;

  [[nodiscard]] base::Task<> work(Entry& entry, ExportWish wish);
  [[nodiscard]] base::Result<> make_folder();
  void tidy_up();
  Entries::iterator remove(Entries::iterator entry);

  base::Loop& loop_;
  MapExporter& exporter_;
  Limits limits_;
  std::filesystem::path folder_;  ///< empty until something is to lie in it
  std::uint64_t started_ = 0;
  Entries entries_;
};

}  // namespace lapwing::station
