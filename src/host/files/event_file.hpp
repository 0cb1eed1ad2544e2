#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include "base/error.hpp"
#include "missions/event_line.hpp"

namespace lapwing::host {

/// Where `--events` goes: a line of JSON for each thing that happens to a task.
class EventFile {
 public:
  /// "-" is standard output, "" nowhere. Errors: io.
  [[nodiscard]] static base::Result<EventFile> open(std::string const& path);

  /// At once, for who follows a flight.
  void write(tasks::TaskEvent const& event, missions::Carrier const& carrier) const;

 private:
  struct Close {
    void operator()(std::FILE* file) const {
      if (file != stdout) std::fclose(file);
    }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace lapwing::host
