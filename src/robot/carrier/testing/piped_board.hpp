#pragma once

#include <memory>

#include "base/async/scope.hpp"
#include "firmware/program.hpp"
#include "firmware/testing/rig.hpp"
#include "firmware/testing/wheel_body.hpp"
#include "link/byte_link.hpp"

namespace lapwing::robot::testing {

/// A body whose program runs on the loop, at the far end of a byte link.
class PipedBoard {
 public:
  PipedBoard(base::Loop& loop, link::ByteLink& link,
             firmware::Description const& description = firmware::testing::office_robot());

  firmware::testing::WheelBody body;
  /// Neither way does a byte arrive.
  bool is_unplugged = false;
  /// So many of the next sends of the host are swallowed.
  int lose_frames = 0;
  /// As after a loss of supply.
  void start_anew();
  [[nodiscard]] firmware::Program const& program() const { return *program_; }

 private:
  base::Task<> run();

  base::Loop& loop_;
  firmware::Description description_;
  link::ByteLink& link_;
  std::unique_ptr<firmware::Program> program_;
  base::TimePoint started_;
  base::Scope scope_;
};

}  // namespace lapwing::robot::testing
