#include "base/scope.hpp"

#include <utility>

namespace lapwing::base {

void Scope::spawn(Task<void> task) {
  children_->push_back(Child{children_, {}, loop_, std::move(task)});
  auto self = std::prev(children_->end());
  self->self = self;
  self->task.on_end(&Scope::bury_later, &*self);
  self->task.start();
}

// The frame is still on the stack when it reports its end, so it is destroyed on a later turn; by then the scope may be
// gone, and the child with it.
void Scope::bury_later(void* child) noexcept {
  auto& ended = *static_cast<Child*>(child);
  ended.loop.post([family = ended.family, self = ended.self] {
    if (auto children = family.lock()) children->erase(self);
  });
}

}  // namespace lapwing::base
