#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/async/child_program.hpp"
#include "base/descriptor.hpp"

namespace lapwing::base {

/// Another program that is told things on its standard input and answers on its standard output. Every call waits, no
/// longer than it is told: for a thread beside the loop (`SideThread`). It ends with this.
class TalkingChild {
 public:
  using Deadline = std::chrono::steady_clock::time_point;

  /// `stop`: a descriptor that becomes readable when nobody waits any more, whichever thread has it so; it outlives
  /// this. The program's `longest` is best 0. Errors: not_found when there is no such program; io.
  [[nodiscard]] static Result<std::unique_ptr<TalkingChild>> start(ChildProgram const& program, int stop);
  TalkingChild(TalkingChild const&) = delete;
  TalkingChild& operator=(TalkingChild const&) = delete;
  ~TalkingChild();

  /// Errors: timed_out; cancelled by `stop`; lost when it has ended, with what it said of it.
  [[nodiscard]] Result<> send(std::string_view bytes, Deadline deadline);
  /// Some of what it answers, at least one byte, as much as there is now and room for. Errors: those of `send`.
  [[nodiscard]] Result<std::size_t> receive(std::span<char> into, Deadline deadline);

 private:
  TalkingChild(std::string name, pid_t pid, Descriptor talk, Descriptor errors, int stop)
      : name_(std::move(name)), pid_(pid), talk_(std::move(talk)), errors_(std::move(errors)), stop_(stop) {}

  /// Until the program takes or gives something, as `events` of poll(2) say.
  [[nodiscard]] Result<> wait_for(short events, Deadline deadline);
  /// False when it will say nothing more there.
  bool hear_errors();
  [[nodiscard]] std::unexpected<Error> ended();

  std::string name_;
  pid_t pid_;
  Descriptor talk_;
  Descriptor errors_;
  bool errors_are_open_ = true;
  int stop_;
  std::string last_words_;
};

}  // namespace lapwing::base
