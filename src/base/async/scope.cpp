#include "base/async/scope.hpp"

#include <utility>

namespace lapwing::base {

void Scope::spawn(Task<void> task) {
  children_->push_back(Child{*this, children_, {}, std::move(task)});
  auto self = std::prev(children_->end());
  self->self = self;
  self->task.on_end(&Scope::bury_later, &*self);
  self->task.start();
}

void Scope::clear() {
  auto cancelled = std::exchange(children_, std::make_shared<Children>());
  cancelled.reset();
  emptied_.notify_all();
}

Task<> Scope::join() {
  while (!empty()) co_await emptied_.wait();
}

Task<bool> Scope::join_until(TimePoint deadline) {
  while (!empty()) {
    if (loop_.now() >= deadline) co_return false;
    co_await emptied_.wait_until(deadline);
  }
  co_return true;
}

// The frame is still on the stack when it reports its end, so it is destroyed on a later turn; by then the scope may be
// gone, and the child with it.
void Scope::bury_later(void* child) noexcept {
  auto& ended = *static_cast<Child*>(child);
  ended.scope.loop_.post([siblings = ended.siblings, self = ended.self, &scope = ended.scope] {
    auto const children = siblings.lock();
    if (!children) return;
    children->erase(self);
    if (children->empty()) scope.emptied_.notify_all();
  });
}

}  // namespace lapwing::base
