#pragma once

#include <coroutine>
#include <exception>
#include <optional>
#include <utility>

#include "base/assert.hpp"

namespace lapwing::base {

template <class T>
class Task;

namespace internal {

/// Resumes whoever awaits the task when it ends; a task that nobody awaits just stays at its end.
///
/// Not by symmetric transfer: g++ 12 turns that into a tail call only when it optimises, so a loop over tasks that end
/// at once would grow the stack in debug and sanitizer builds. A child that ends within its parent's `await_suspend` is
/// noticed there.
struct FinalAwaiter {
  [[nodiscard]] bool await_ready() const noexcept { return false; }
  template <class Promise>
  void await_suspend(std::coroutine_handle<Promise> ended) const noexcept {
    auto& promise = ended.promise();
    if (promise.starting) return;
    if (promise.continuation) return promise.continuation.resume();
    if (promise.on_end) promise.on_end(promise.on_end_context);
  }
  void await_resume() const noexcept {}
};

struct PromiseBase {
  std::coroutine_handle<> continuation;
  void (*on_end)(void*) noexcept = nullptr;
  void* on_end_context = nullptr;
  bool starting = false;  ///< the parent is still inside `await_suspend`

  [[nodiscard]] std::suspend_always initial_suspend() const noexcept { return {}; }
  [[nodiscard]] FinalAwaiter final_suspend() const noexcept { return {}; }
  // Expected failures are values (`Result`). An exception that gets here is a broken contract: die where it happened.
  [[noreturn]] void unhandled_exception() const noexcept { std::terminate(); }
};

template <class T>
struct Promise : PromiseBase {
  std::optional<T> value;
  Task<T> get_return_object();
  template <class U>
  void return_value(U&& result) {
    value.emplace(std::forward<U>(result));
  }
  T take() {
    LAPWING_ASSERT(value.has_value());
    return std::move(*value);
  }
};

template <>
struct Promise<void> : PromiseBase {
  Task<void> get_return_object();
  void return_void() const noexcept {}
  void take() const noexcept {}
};

}  // namespace internal

/// A coroutine that the holder owns: lazy (runs when awaited or started), cancelled by destroying it.
///
/// Destroying a suspended task destroys its locals, so also the tasks it awaits and every place it waits in. A task
/// must not destroy itself while it runs: leave that to a later turn (`Loop::post`). Parameters go by value, long-lived
/// components by reference. g++ 12 destroys some temporaries in an awaiting expression twice: name them first.
template <class T = void>
class [[nodiscard]] Task {
 public:
  using promise_type = internal::Promise<T>;
  using Handle = std::coroutine_handle<promise_type>;

  Task() = default;
  explicit Task(Handle handle) : handle_(handle) {}
  Task(Task&& other) noexcept : handle_(std::exchange(other.handle_, {})) {}
  Task& operator=(Task&& other) noexcept {
    if (this != &other) {
      destroy();
      handle_ = std::exchange(other.handle_, {});
    }
    return *this;
  }
  ~Task() { destroy(); }

  [[nodiscard]] bool await_ready() const noexcept { return handle_.done(); }
  /// Runs the task to its first suspension; false when it got to its end, so that the awaiting coroutine goes on.
  bool await_suspend(std::coroutine_handle<> awaiting) {
    auto& promise = handle_.promise();
    promise.continuation = awaiting;
    promise.starting = true;
    handle_.resume();
    promise.starting = false;
    return !handle_.done();
  }
  T await_resume() { return handle_.promise().take(); }

  /// For owners that do not await: run to the first suspension, ask, take the result once, when it is done.
  void start() { handle_.resume(); }
  [[nodiscard]] bool done() const { return handle_.done(); }
  T take() { return handle_.promise().take(); }
  /// `notify(context)` is called once, as the last act of the task, which is then suspended for good.
  void on_end(void (*notify)(void*) noexcept, void* context) {
    handle_.promise().on_end = notify;
    handle_.promise().on_end_context = context;
  }

 private:
  void destroy() {
    if (handle_) std::exchange(handle_, {}).destroy();
  }
  Handle handle_;
};

template <class T>
Task<T> internal::Promise<T>::get_return_object() {
  return Task<T>(Task<T>::Handle::from_promise(*this));
}
inline Task<void> internal::Promise<void>::get_return_object() {
  return Task<void>(Task<void>::Handle::from_promise(*this));
}

}  // namespace lapwing::base
