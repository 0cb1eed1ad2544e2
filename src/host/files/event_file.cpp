#include "host/files/event_file.hpp"

#include <fmt/format.h>

namespace lapwing::host {

base::Result<EventFile> EventFile::open(std::string const& path) {
  EventFile events;
  if (path.empty()) return events;
  events.file_.reset(path == "-" ? stdout : std::fopen(path.c_str(), "w"));
  if (!events.file_) return base::fail(base::ErrorKind::io, fmt::format("{}: cannot write", path));
  return events;
}

void EventFile::write(tasks::TaskEvent const& event, missions::Carrier const& carrier) const {
  if (!file_) return;
  fmt::print(file_.get(), "{}\n", missions::event_line(event, carrier));
  std::fflush(file_.get());
}

}  // namespace lapwing::host
