#pragma once

#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "base/log.hpp"
#include "host/links/ground.hpp"

namespace lapwing::host {

/// Links and the vehicles on them, for verbs that do one thing with vehicles and end. Asks vehicles for nothing by
/// itself.
class LinkSession {
 public:
  /// `source` is the verb's name in the log, of which warnings go to standard error; what vehicles say of themselves
  /// does not.
  LinkSession(SigningSetup signing, std::string const& source, base::Loop::Pace pace = {});

  /// The links, or the default link when there are none. Errors: `Ground::open`.
  [[nodiscard]] base::Result<> open(std::vector<std::string> const& urls);
  /// Runs to the job's end and returns its exit code. An interrupt breaks the job off; then `clean_up` is run.
  [[nodiscard]] int run(base::Task<int> job, base::Task<> clean_up);
  [[nodiscard]] int run(base::Task<int> job);

  base::Loop loop;
  base::LogHub hub;
  base::Logger log;
  Ground ground;

 private:
  struct Work;

  SigningTimeKeeper keeper_;
};

}  // namespace lapwing::host
