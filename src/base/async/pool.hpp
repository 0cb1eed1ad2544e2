#pragma once

#include <concepts>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <ranges>
#include <stop_token>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "base/async/internal/pool_queue.hpp"
#include "base/async/loop.hpp"

/// Work beside the loop: `auto map = co_await loop.on_pool(match, std::move(scan), options);`
///
/// `match` is a pure function: values in, a value out. It runs on one of a few threads; arguments are copied or moved
/// in, and what it returns or throws comes back on the loop. A function whose first parameter is a `std::stop_token` is
/// given one.
///
/// - Order: results come in the order in which the jobs were submitted, whichever is done first. Without a pace, one
///   comes when nothing else is left to do, and time does not advance while one is awaited: a run repeats exactly on
///   any number of threads. At another pace than the wall's, time waits for them, too. At the wall's it does not.
/// - Full: a job waits for a thread, in the same order, and with it the coroutine that awaits it. So nothing is refused
///   or lost, and no more jobs wait than coroutines do. Who makes a job of everything that comes in faster than it can
///   be worked off puts a `Mailbox` before one coroutine, and says there what to drop.
/// - Cancelling: destroying the awaiting task. A job that has not begun is dropped; one that has is asked to stop
///   through its token, and what it returns is thrown away.
/// - Ends: the loop's destructor waits for what still runs. What may take long takes a token and looks at it.
///
/// The reasons: docs/adr/0010-work-beside-the-loop.md.
namespace lapwing::base {

namespace internal {

template <class T>
constexpr bool borrows = std::is_pointer_v<T>;
template <class T>
constexpr bool borrows<std::reference_wrapper<T>> = true;
template <class T>
constexpr bool borrows<std::weak_ptr<T>> = true;
template <class T>
constexpr bool borrows<std::shared_ptr<T>> = !std::is_const_v<T>;
template <class T>
constexpr bool borrows<Task<T>> = true;  // a part of its loop

/// std::string_view, std::span: what they show belongs to somebody else.
template <class T>
concept BorrowedView = std::ranges::view<T> && std::ranges::borrowed_range<T>;

}  // namespace internal

/// What may go to another thread and come back: a value that owns what it holds, or shares what nobody changes
/// (`std::shared_ptr<Map const>`). What a struct's members refer to cannot be seen here and is the author's promise.
template <class T>
concept PoolValue =
    std::is_object_v<T> && std::move_constructible<T> && !internal::borrows<T> && !internal::BorrowedView<T>;

/// A function and nothing else: a lambda that captures nothing, a function's or member function's address, an empty
/// function object. What it needs are arguments, so that everything that crosses can be seen.
template <class F>
concept PoolFunction = (std::is_class_v<F> && std::is_empty_v<F>) || std::is_function_v<std::remove_pointer_t<F>> ||
                       std::is_member_function_pointer_v<F>;

template <class F, class... Args>
concept TakesStopToken = std::invocable<F, std::stop_token, Args...>;

namespace internal {

template <class F, class... Args>
struct PoolResult : std::invoke_result<F, Args...> {};
template <class F, class... Args>
  requires TakesStopToken<F, Args...>
struct PoolResult<F, Args...> : std::invoke_result<F, std::stop_token, Args...> {};

}  // namespace internal

template <class F, class... Args>
using PoolResult = internal::PoolResult<F, Args...>::type;

template <class F, class... Args>
concept PoolCall =
    PoolFunction<F> && (PoolValue<Args> && ...) && (std::invocable<F, Args...> || TakesStopToken<F, Args...>) &&
    (std::is_void_v<PoolResult<F, Args...>> || PoolValue<PoolResult<F, Args...>>);

/// What `Loop::on_pool` gives: await it once, at once.
template <class F, class... Args>
class [[nodiscard]] PoolJob : internal::PoolWait {
  static_assert(PoolCall<F, Args...>,
                "on_pool takes a function without captures and values that own what they hold, and gives one back");

 public:
  using Result = PoolResult<F, Args...>;

  template <class... Given>
  explicit PoolJob(Loop& loop, F function, Given&&... args)
      : PoolWait(loop, std::make_shared<Call>(function, std::forward<Given>(args)...)) {}

  [[nodiscard]] bool await_ready() const noexcept { return false; }
  void await_suspend(std::coroutine_handle<> handle) { submit(handle); }
  /// What the function returned, or throws what it threw: catch that where a library throws, for an exception that
  /// leaves a task ends the process.
  Result await_resume() { return static_cast<Call&>(work()).take(); }

 private:
  class Call;
};

template <class F, class... Args>
class PoolJob<F, Args...>::Call final : public internal::Work {
 public:
  template <class... Given>
  explicit Call(F function, Given&&... args) : function_(function), args_(std::in_place, std::forward<Given>(args)...) {
    if constexpr (TakesStopToken<F, Args...>) stop_ = std::stop_source();
  }

  Result take() {
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
    // Nothing of it stays: the thread that worked it out may be the last to let go of this, at any time.
    if constexpr (!std::is_void_v<Result>) return *std::exchange(result_, std::nullopt);
  }

 private:
  using Kept = std::conditional_t<std::is_void_v<Result>, std::monostate, std::optional<Result>>;

  void run() noexcept override {
    try {
      if constexpr (std::is_void_v<Result>) {
        call();
      } else {
        result_.emplace(call());
      }
    } catch (...) {
      thrown_ = std::current_exception();
    }
    args_.reset();  // here and not on the loop, whose time is dearer
  }
  Result call() {
    return std::apply(
        [this](Args&... args) -> Result {
          if constexpr (TakesStopToken<F, Args...>) {
            return std::invoke(function_, stop_.get_token(), std::move(args)...);
          } else {
            return std::invoke(function_, std::move(args)...);
          }
        },
        *args_);
  }

  [[no_unique_address]] F function_;
  std::optional<std::tuple<Args...>> args_;
  Kept result_;
  std::exception_ptr thrown_;
};

template <class F, class... Args>
PoolJob<F, std::decay_t<Args>...> Loop::on_pool(F function, Args&&... args) {
  return PoolJob<F, std::decay_t<Args>...>(*this, function, std::forward<Args>(args)...);
}

}  // namespace lapwing::base
