#include "host/eyes/looking_child.hpp"

#include <sys/eventfd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/async/talking_child.hpp"

namespace lapwing::host {

using namespace std::chrono_literals;
using base::ErrorKind;

namespace {

constexpr std::uint64_t most_memory_bytes = std::uint64_t{4} << 30U;  // OpenCV, Tesseract and networks, and room
constexpr base::Duration first_wait = 1s;
constexpr int most_doublings = 6;  // of it: a minute

}  // namespace

/// What the thread beside the loop has of it.
class LookingChild::Talk {
 public:
  Talk(Settings const& settings, int stop) : program_(settings.program), longest_(settings.longest_look), stop_(stop) {}

  base::Result<LookFrame> ask(std::string const& request) {
    auto answer = exchange(request);
    if (!answer) child_.reset();
    return answer;
  }

 private:
  base::Result<LookFrame> exchange(std::string const& request) {
    auto const deadline = std::chrono::steady_clock::now() + longest_;
    if (!child_) {
      auto started = base::TalkingChild::start(program_, stop_);
      if (!started) return std::unexpected(started.error());
      child_ = *std::move(started);
      reader_ = {};
    }
    if (auto sent = child_->send(request, deadline); !sent) return std::unexpected(sent.error());
    std::array<char, 65'536> piece{};
    for (;;) {
      auto answer = reader_.next();
      if (!answer) return std::unexpected(answer.error());
      // What comes after an answer and before a question answers nothing.
      if (*answer && !reader_.is_empty())
        return base::fail(ErrorKind::invalid_input, "it says more than it was asked for");
      if (*answer) return **std::move(answer);
      auto const count = child_->receive(piece, deadline);
      if (!count) return std::unexpected(count.error());
      reader_.take(std::string_view(piece.data(), *count));
    }
  }

  base::ChildProgram program_;
  std::chrono::seconds longest_;
  int stop_;
  std::unique_ptr<base::TalkingChild> child_;
  LookFrameReader reader_;
};

base::ChildProgram LookingChild::program_beside_us(std::string const& name, std::string const& word) {
  std::error_code error;
  auto const folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  return {.program = folder / name, .words = {word}, .longest = 0s, .most_memory_bytes = most_memory_bytes};
}

LookingChild::LookingChild(base::Loop& loop, Settings settings, base::Logger log)
    : loop_(loop),
      takes_(settings.takes),
      log_(std::move(log)),
      stop_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      thread_(std::make_unique<base::SideThread<Talk>>(loop, std::make_unique<Talk>(settings, stop_.get()))) {}

LookingChild::~LookingChild() {
  std::uint64_t const one = 1;
  (void)stop_.write_all({reinterpret_cast<char const*>(&one), sizeof one});
}

/// While somebody awaits an answer, also if he gives up.
class LookingChild::Owed {
 public:
  explicit Owed(LookingChild& by) : by_(by) {
    if (by_.asked_++ == 0) by_.asked_since_ = by_.loop_.now();
  }
  ~Owed() {
    // The next one's turn begins now: requests are met one after the other.
    by_.asked_since_ = --by_.asked_ > 0 ? std::optional(by_.loop_.now()) : std::nullopt;
  }
  Owed(Owed const&) = delete;
  Owed& operator=(Owed const&) = delete;

 private:
  LookingChild& by_;
};

base::Task<base::Result<LookFrame>> LookingChild::ask(Request request) {
  if (!may_be_asked())
    co_return base::fail(is_missing_ ? ErrorKind::not_found : ErrorKind::lost, "nobody looks at pictures now");
  auto job = [request = std::move(request)](Talk& talk) mutable { return talk.ask(to_bytes(request())); };
  Owed const owed(*this);
  auto talk = takes_ ? thread_->run_in_time(std::move(job), *takes_) : thread_->run(std::move(job));
  auto answer = co_await std::move(talk);
  note(answer);
  co_return answer;
}

void LookingChild::note(base::Result<LookFrame> const& answer) {
  if (answer) {
    if (std::exchange(failures_, 0) > 0) log_.info("pictures are looked at again");
    return;
  }
  if (answer.error().kind == ErrorKind::cancelled) return;
  if (answer.error().kind == ErrorKind::not_found) {
    if (!std::exchange(is_missing_, true))
      log_.warn(
          fmt::format("pictures are not looked at: {}; ./lapwing run and ./lapwing demo make it where they need it",
                      answer.error().message));
    return;
  }
  if (failures_ == 0) log_.warn(fmt::format("what looks at pictures is started anew: {}", answer.error().message));
  not_before_ = loop_.now() + first_wait * (1 << std::min(failures_, most_doublings));
  ++failures_;
}

}  // namespace lapwing::host
