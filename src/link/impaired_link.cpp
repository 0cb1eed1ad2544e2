#include "link/impaired_link.hpp"

#include <random>
#include <utility>

#include "base/async/scope.hpp"

namespace lapwing::link {

namespace {

using Chunk = std::vector<std::uint8_t>;

class ImpairedLink final : public ByteLink {
 public:
  ImpairedLink(base::Loop& loop, std::unique_ptr<ByteLink> inner, Impairment impairment)
      : loop_(loop), inner_(std::move(inner)), impairment_(impairment), random_(impairment.seed), scope_(loop) {}

  [[nodiscard]] std::string name() const override { return inner_->name(); }
  [[nodiscard]] std::string peer_name(Peer peer) const override { return inner_->peer_name(peer); }
  [[nodiscard]] LinkState state() const override { return inner_->state(); }
  [[nodiscard]] std::string last_error() const override { return inner_->last_error(); }
  [[nodiscard]] LinkCounters counters() const override { return inner_->counters(); }
  [[nodiscard]] std::optional<double> bytes_per_s() const override { return inner_->bytes_per_s(); }
  [[nodiscard]] std::vector<Peer> standing_peers() const override { return inner_->standing_peers(); }

  void start(Receive receive) override {
    receive_ = std::move(receive);
    inner_->start([this](Peer peer, Bytes bytes) {
      for (int copies = arrivals(); copies > 0; --copies)
        scope_.spawn(deliver(peer, Chunk(bytes.begin(), bytes.end())));
    });
  }

  /// What is lost later was sent all the same.
  bool send(Peer peer, Bytes bytes, Urgency urgency) override {
    if (urgency == Urgency::batched) urgency = Urgency::prompt;  // nobody flushes when it goes on
    for (int copies = arrivals(); copies > 0; --copies)
      scope_.spawn(pass_on(peer, Chunk(bytes.begin(), bytes.end()), urgency));
    return inner_->state() == LinkState::open;
  }

 private:
  [[nodiscard]] bool happens(double probability) { return std::uniform_real_distribution<>()(random_) < probability; }
  [[nodiscard]] int arrivals() {
    if (happens(impairment_.loss)) return 0;
    return happens(impairment_.duplication) ? 2 : 1;
  }
  [[nodiscard]] base::Duration lateness() {
    if (impairment_.jitter <= base::Duration::zero()) return impairment_.delay;
    std::uniform_int_distribution<base::Duration::rep> more(0, impairment_.jitter.count());
    return impairment_.delay + base::Duration(more(random_));
  }

  base::Task<void> deliver(Peer peer, Chunk chunk) {
    co_await loop_.sleep(lateness());
    receive_(peer, chunk);
    tell_drained();
  }
  base::Task<void> pass_on(Peer peer, Chunk chunk, Urgency urgency) {
    co_await loop_.sleep(lateness());
    inner_->send(peer, chunk, urgency);
  }

  base::Loop& loop_;
  std::unique_ptr<ByteLink> inner_;
  Impairment impairment_;
  std::mt19937_64 random_;
  Receive receive_;
  base::Scope scope_;
};

}  // namespace

std::unique_ptr<ByteLink> impair(base::Loop& loop, std::unique_ptr<ByteLink> inner, Impairment impairment) {
  return std::make_unique<ImpairedLink>(loop, std::move(inner), impairment);
}

}  // namespace lapwing::link
