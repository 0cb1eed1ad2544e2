#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/time.hpp"

namespace lapwing::apps {

/// good: as it should be · note: may be meant so · wrong: something will not work.
enum class Verdict { good, note, wrong };

struct Finding {
  Verdict verdict;
  std::string what;
  std::string advice = {};  ///< how to mend it
};
using Findings = std::vector<Finding>;

[[nodiscard]] bool any_wrong(Findings const& findings);
/// One line a finding, its advice below.
[[nodiscard]] std::string render(Findings const& findings);

/// Tools of the build on `search_path` (as in PATH), and what the launcher makes in `home`.
[[nodiscard]] Findings look_at_installation(std::filesystem::path const& home, std::string const& search_path);
/// Serial devices in `folder` (/dev) that autopilots and telemetry radios show up as.
[[nodiscard]] Findings look_at_serial_devices(std::filesystem::path const& folder);
/// Whether the map can be served on this TCP port of 127.0.0.1.
[[nodiscard]] Findings look_at_map_port(int port);

/// Listens on the link for that long and says which vehicles spoke, and what else did. Silence is wrong when
/// `must_answer`, else a note.
[[nodiscard]] Findings listen(std::string const& url, base::Duration time, bool must_answer);

}  // namespace lapwing::apps
