#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "base/descriptor.hpp"
#include "base/error.hpp"
#include "base/time.hpp"

namespace lapwing::onboard {

/// A process of the vehicle, by what starts it.
struct ProcessSpec {
  std::string name;
  std::vector<std::string> command = {};  ///< the program and its words
  /// It says over the life line that it lives (life_line.hpp), and is ended when it does not.
  bool tells_life = true;
  /// 0 to 19: how far it steps back behind the supervisor where processors are scarce. One that does is also ended
  /// before the others where memory is.
  int niceness = 0;
};

/// What the system says of a child.
struct ChildChange {
  enum class Kind { exited, killed, stopped };
  Kind kind{};
  int code = 0;  ///< its exit code or the signal
};
/// "killed by signal 9 (Killed)".
[[nodiscard]] std::string to_string(ChildChange const& change);

/// One that runs, in a process group of its own, so that a Ctrl-C for the supervisor is none for it; its output is the
/// supervisor's. It is killed with this.
class Child {
 public:
  /// Error: not_found, io.
  [[nodiscard]] static base::Result<Child> start(ProcessSpec const& spec);
  Child(Child&& other) noexcept;
  Child& operator=(Child&&) = delete;
  ~Child();

  [[nodiscard]] pid_t pid() const { return pid_; }
  /// What has happened since the last call. After an end there is nothing more to ask.
  [[nodiscard]] std::optional<ChildChange> look();
  /// Whether it has said since the last call that it lives.
  [[nodiscard]] bool has_lived();
  /// How long its first thread, which says that it lives, has been ready to run and had no processor; nothing where
  /// the system does not count that.
  [[nodiscard]] std::optional<base::Duration> waited() const;
  /// To it and all that it has started.
  void signal(int number) const;

 private:
  Child(pid_t pid, base::Descriptor life) : pid_(pid), life_(std::move(life)) {}
  pid_t pid_;
  base::Descriptor life_;
};

}  // namespace lapwing::onboard
