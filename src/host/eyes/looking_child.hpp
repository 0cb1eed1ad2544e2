#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/async/child_program.hpp"
#include "base/async/side_thread.hpp"
#include "base/descriptor.hpp"
#include "base/log.hpp"
#include "host/eyes/look_frame.hpp"

namespace lapwing::host {

/// Has a program of its own look at pictures, which needs libraries that this one does without: `lapwing look`. It is
/// started when it is first asked; one that dies, hangs or talks nonsense is ended and started anew, later each time
/// until it answers again. Where it was not built nothing is seen, which is said once. The loop never waits.
///
/// Thread-bound; the loop outlives it.
class LookingChild {
 public:
  struct Settings {
    base::ChildProgram program;
    /// What a look takes in time that is not the wall's, which waits if it takes longer, so that a run repeats;
    /// nothing: for the wall's, which goes on.
    std::optional<base::Duration> takes = std::chrono::milliseconds(400);
    std::chrono::seconds longest_look{30};  ///< of the wall's time; longer, and it hangs
  };
  LookingChild(base::Loop& loop, Settings settings, base::Logger log);
  LookingChild(LookingChild const&) = delete;
  LookingChild& operator=(LookingChild const&) = delete;
  ~LookingChild();

  /// That of the folder of the one that runs, with the word that it is to be started with.
  [[nodiscard]] static base::ChildProgram program_beside_us(std::string const& name, std::string const& word);

  /// Worth a picture: not when there is no such program, nor just after it has died.
  [[nodiscard]] bool may_be_asked() const { return !is_missing_ && loop_.now() >= not_before_; }
  /// There is no such program.
  [[nodiscard]] bool is_missing() const { return is_missing_; }
  /// The last time it gave no sound answer.
  [[nodiscard]] bool is_failing() const { return failures_ > 0; }
  /// Since when it owes an answer; nothing while it owes none.
  [[nodiscard]] std::optional<base::TimePoint> asked_since() const { return asked_since_; }
  /// What makes a request on the thread beside the loop, where a picture may take its time: it touches nothing of the
  /// loop's.
  using Request = std::move_only_function<LookFrame()>;
  /// The answer; requests are met one after the other. Errors: not_found when there is no such program; lost, timed_out
  /// and invalid_input when there was no sound answer, and until it is tried again.
  [[nodiscard]] base::Task<base::Result<LookFrame>> ask(Request request);

 private:
  class Talk;
  class Owed;

  void note(base::Result<LookFrame> const& answer);

  base::Loop& loop_;
  std::optional<base::Duration> takes_;
  base::Logger log_;
  bool is_missing_ = false;
  int failures_ = 0;  ///< one after the other
  base::TimePoint not_before_{};
  int asked_ = 0;  ///< that it has not answered
  std::optional<base::TimePoint> asked_since_;
  base::Descriptor stop_;
  std::unique_ptr<base::SideThread<Talk>> thread_;
};

}  // namespace lapwing::host
