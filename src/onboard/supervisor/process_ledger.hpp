#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/descriptor.hpp"
#include "base/error.hpp"
#include "onboard/supervisor/process_mark.hpp"
#include "onboard/supervisor/supervisor.hpp"

namespace lapwing::onboard {

/// The processes of a vehicle, written down in its state folder, so that a supervisor finds what one before it has left
/// when it was killed. One supervisor at a time has it: two of them would fly one drone.
class ProcessLedger {
 public:
  /// Makes the folder where there is none. Errors: refused, another supervisor has it; io.
  [[nodiscard]] static base::Result<ProcessLedger> open(std::filesystem::path const& folder);

  /// What an earlier supervisor had started and still runs, in the order in which it was started.
  [[nodiscard]] std::vector<ProcessMark> left_over() const;
  /// Writes down what runs now, beside what was left over and still runs. Error: io.
  [[nodiscard]] base::Result<> note(std::vector<ProcessStatus> const& all) const;

 private:
  ProcessLedger(std::filesystem::path file, base::Descriptor lock);

  std::filesystem::path file_;
  base::Descriptor lock_;  ///< the system lets go of it with this process, however that ends
  std::vector<ProcessMark> found_;
};

/// As it is written: JSON. Marks of another start of the machine, and what makes no sense, are left out.
[[nodiscard]] std::string ledger_text(std::vector<ProcessMark> const& marks, std::string const& boot);
[[nodiscard]] std::vector<ProcessMark> read_ledger(std::string_view text, std::string const& boot);

}  // namespace lapwing::onboard
