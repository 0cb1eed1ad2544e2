#include "robot/carrier/testing/piped_board.hpp"

#include <chrono>
#include <utility>

namespace lapwing::robot::testing {

using namespace std::chrono_literals;

PipedBoard::PipedBoard(base::Loop& loop, link::ByteLink& link, firmware::Description const& description)
    : body(description, {}), loop_(loop), description_(description), link_(link), started_(loop.now()), scope_(loop) {
  start_anew();
  link_.start([this](link::Peer, link::Bytes bytes) {
    if (is_unplugged) return;
    if (lose_frames > 0) {
      --lose_frames;
      return;
    }
    body.to_board.insert(body.to_board.end(), bytes.begin(), bytes.end());
  });
  scope_.spawn(run());
}

void PipedBoard::start_anew() {
  body.to_board.clear();
  program_ = std::make_unique<firmware::Program>(body, description_);
  started_ = loop_.now();
}

base::Task<> PipedBoard::run() {
  for (;;) {
    co_await loop_.sleep(10ms);
    body.advance(10ms);
    program_->step(std::chrono::duration_cast<firmware::Time>(loop_.now() - started_));
    auto const bytes = std::exchange(body.from_board, {});
    auto const peers = link_.standing_peers();
    if (!is_unplugged && !bytes.empty() && !peers.empty()) link_.send(peers.front(), bytes);
  }
}

}  // namespace lapwing::robot::testing
