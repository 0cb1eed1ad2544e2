#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/log.hpp"
#include "vehicle/alarm.hpp"

namespace lapwing::fleet {

/// Writes what is true of many vehicles at once as one line: when 250 fall silent together, the log says so, and not
/// 250 times that one did.
///
/// The first of a kind is written at once. What follows within a second is gathered and then written together.
class RollCall {
 public:
  explicit RollCall(base::Logger log) : log_(std::move(log)) {}

  /// This has begun for that vehicle.
  void begins(vehicle::Alarm const& alarm) { waiting_[{alarm.kind, true}].push_back(entry_of(alarm, alarm.words)); }
  /// This is over for it; `words` is the whole line.
  void ends(vehicle::Alarm const& alarm, std::string words) {
    waiting_[{alarm.kind, false}].push_back(entry_of(alarm, std::move(words)));
  }
  /// Writes what is due. To be called after every turn in which something was said, and some times a second.
  void flush(base::TimePoint now);

 private:
  struct Entry {
    std::string name;
    std::string words;
    vehicle::Severity severity;
  };
  using Subject = std::pair<vehicle::AlarmKind, bool>;  ///< whether it begins
  [[nodiscard]] static Entry entry_of(vehicle::Alarm const& alarm, std::string words) {
    return {alarm.name, std::move(words), alarm.severity};
  }
  void write(Subject subject, std::vector<Entry> const& entries) const;

  base::Logger log_;
  std::map<Subject, std::vector<Entry>> waiting_;
  std::map<Subject, base::TimePoint> written_;
};

}  // namespace lapwing::fleet
