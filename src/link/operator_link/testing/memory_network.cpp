#include "link/operator_link/testing/memory_network.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/async/scope.hpp"

namespace lapwing::link::operator_link::testing {

namespace {

using Piece = std::vector<std::uint8_t>;

}  // namespace

struct internal::Line : std::enable_shared_from_this<Line> {
  struct End {
    ByteStream::Events events;
    bool is_started = false;
    bool is_open = true;
    bool is_paused = false;
    std::list<Piece> arrived;         ///< not read yet
    std::size_t written_backlog = 0;  ///< by this end, not read by the other
  };
  Line(base::Loop& on, std::uint64_t seed, Weather its) : loop(on), random(seed), weather(its), scope(on) {}

  /// Pieces from one end reach the other in order, since all are delayed alike.
  void write(std::size_t from, Bytes bytes) {
    while (!bytes.empty() && !is_dead) {
      std::uniform_int_distribution<std::size_t> sizes(1, weather.largest_piece);
      auto const size = std::min({sizes(random), bytes.size(), weather.dies_after});
      if (size == 0) return die();
      weather.dies_after -= weather.dies_after == std::numeric_limits<std::size_t>::max() ? 0 : size;
      ends[from].written_backlog += size;
      scope.spawn(carry(from, Piece(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))));
      bytes = bytes.subspan(size);
    }
  }
  base::Task<> carry(std::size_t from, Piece piece) {
    co_await loop.sleep(weather.delay);
    ends[1 - from].arrived.push_back(std::move(piece));
    read(1 - from);
  }
  void read(std::size_t to) {
    auto const self = shared_from_this();
    auto& end = ends[to];
    while (end.is_started && end.is_open && !end.is_paused && !end.arrived.empty()) {
      auto const piece = std::move(end.arrived.front());
      end.arrived.pop_front();
      ends[1 - to].written_backlog -= piece.size();
      if (end.events.data) end.events.data(piece);
      auto& writer = ends[1 - to];
      if (writer.written_backlog == 0 && writer.is_open && writer.is_started && writer.events.drained)
        writer.events.drained();
    }
  }
  /// What is on its way is lost.
  void die() {
    if (std::exchange(is_dead, true)) return;
    loop.post([weak = weak_from_this()] {
      auto const self = weak.lock();
      if (!self) return;
      self->scope.clear();
      if (!self->weather.tells_of_its_end) return;
      for (auto& end : self->ends) {
        end.arrived.clear();
        if (end.is_started && std::exchange(end.is_open, false) && end.events.ended) end.events.ended("cut");
      }
    });
  }
  /// By one end: what it wrote before still arrives, and then the other hears of it.
  base::Task<> hang_up() {
    co_await loop.sleep(weather.delay);
    co_await loop.turn();
    die();
  }

  base::Loop& loop;
  std::mt19937_64 random;
  Weather weather;
  std::array<End, 2> ends;
  bool is_dead = false;
  base::Scope scope;
};

namespace {

class MemoryStream final : public ByteStream {
 public:
  MemoryStream(std::shared_ptr<internal::Line> line, std::size_t end) : line_(std::move(line)), end_(end) {}
  MemoryStream(MemoryStream const&) = delete;
  MemoryStream& operator=(MemoryStream const&) = delete;
  ~MemoryStream() override { MemoryStream::close(); }

  [[nodiscard]] std::string peer_name() const override { return "memory"; }
  void start(Events events) override {
    self().events = std::move(events);
    self().is_started = true;
    self().is_paused = line_->weather.is_deaf && end_ == 1;
    line_->loop.post([weak = std::weak_ptr(line_), end = end_] {
      auto const line = weak.lock();
      if (!line) return;
      // It may have died before.
      if (line->is_dead && line->weather.tells_of_its_end && std::exchange(line->ends[end].is_open, false))
        return line->ends[end].events.ended("cut");
      line->read(end);
    });
  }
  void write(Bytes bytes) override {
    if (self().is_open) line_->write(end_, bytes);
  }
  [[nodiscard]] std::size_t backlog() const override { return self().written_backlog; }
  void pause(bool is_paused) override {
    self().is_paused = is_paused;
    line_->loop.post([weak = std::weak_ptr(line_), end = end_] {
      if (auto const line = weak.lock()) line->read(end);
    });
  }
  void close() override {
    if (!std::exchange(self().is_open, false)) return;
    line_->scope.spawn(line_->hang_up());
  }

 private:
  [[nodiscard]] internal::Line::End& self() const { return line_->ends[end_]; }
  std::shared_ptr<internal::Line> line_;
  std::size_t end_;
};

}  // namespace

class MemoryNetwork::Waits final : public Listener {
 public:
  explicit Waits(MemoryNetwork& network) : network_(network) {}
  Waits(Waits const&) = delete;
  Waits& operator=(Waits const&) = delete;
  ~Waits() override { network_.accept_ = {}; }
  [[nodiscard]] std::string name() const override { return "memory"; }
  [[nodiscard]] std::uint16_t port() const override { return 0; }
  void start(Accept accept) override { network_.accept_ = std::move(accept); }

 private:
  MemoryNetwork& network_;
};

class MemoryNetwork::Dials final : public Dialler {
 public:
  explicit Dials(MemoryNetwork& network) : network_(network) {}
  [[nodiscard]] std::string name() const override { return "memory"; }
  [[nodiscard]] base::Task<base::Result<std::unique_ptr<ByteStream>>> dial() override {
    co_await network_.loop_.turn();
    auto const of_it = network_.weather();
    if (!of_it || !network_.accept_) co_return base::fail(base::ErrorKind::lost, "nobody listens");
    co_return network_.connect(*of_it);
  }

 private:
  MemoryNetwork& network_;
};

MemoryNetwork::MemoryNetwork(base::Loop& loop, std::uint64_t seed) : loop_(loop), random_(seed) {}
MemoryNetwork::~MemoryNetwork() = default;

std::unique_ptr<Listener> MemoryNetwork::listener() {
  return std::make_unique<Waits>(*this);
}
std::unique_ptr<Dialler> MemoryNetwork::dialler() {
  return std::make_unique<Dials>(*this);
}

std::unique_ptr<ByteStream> MemoryNetwork::connect(Weather of_it) {
  ++connections_;
  auto const line = std::make_shared<internal::Line>(loop_, random_(), of_it);
  std::erase_if(lines_, [](auto const& one) { return one.use_count() == 1; });
  lines_.push_back(line);
  accept_(std::make_unique<MemoryStream>(line, 1));
  return std::make_unique<MemoryStream>(line, 0);
}

void MemoryNetwork::cut() {
  for (auto const& line : lines_) line->die();
}

}  // namespace lapwing::link::operator_link::testing
