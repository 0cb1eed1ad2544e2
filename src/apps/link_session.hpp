#pragma once

#include <string>
#include <vector>

#include "apps/key_file.hpp"
#include "base/log.hpp"
#include "base/loop.hpp"
#include "mavlink/connection.hpp"

namespace lapwing::apps {

/// Links and a MAVLink connection on them, for verbs that do one thing with vehicles and end.
class LinkSession {
 public:
  /// `source` is the verb's name in the log, of which warnings go to standard error.
  LinkSession(SigningSetup const& signing, std::string const& source);

  /// The links, or the default link when there are none. Errors: invalid_input for a wrong URL, io for a port in use.
  [[nodiscard]] base::Result<> open(std::vector<std::string> const& urls);
  /// Runs to the job's end and returns its exit code, or to an interrupt.
  [[nodiscard]] int run(base::Task<int> job);

  base::Loop loop;
  base::LogHub hub;
  base::Logger log;
  mavlink::Connection connection;

 private:
  SigningTimeKeeper keeper_;
};

}  // namespace lapwing::apps
