#include "dolphin/value/value.hpp"

namespace lapwing::dolphin {

Object::Object(Heap& heap, ValueKind kind) : heap_(&heap), next_(heap.first_), kind_(kind) {
  if (next_) next_->previous_ = this;
  heap.first_ = this;
  charge(0);
}

void Object::charge(std::size_t bytes) {
  std::size_t constexpr smallest_object = 64;  // roughly, the allocator's share included
  if (heap_) heap_->bytes_ += smallest_object + bytes - charged_;
  charged_ = smallest_object + bytes;
}

void Object::bury() {
  if (heap_) return heap_->bury(this);
  delete this;
}

void Heap::bury(Object* object) {
  // Out of the list of the living, into the list of the dead, which uses the same link.
  if (object->previous_) object->previous_->next_ = object->next_;
  if (object->next_) object->next_->previous_ = object->previous_;
  if (first_ == object) first_ = object->next_;
  object->previous_ = nullptr;
  object->next_ = buried_;
  buried_ = object;
  if (burying_) return;
  burying_ = true;
  while (buried_) {
    Object* const next = buried_;
    buried_ = next->next_;
    next->next_ = nullptr;
    bytes_ -= next->charged_;
    next->heap_ = nullptr;
    delete next;
  }
  burying_ = false;
}

Heap::~Heap() {
  // Held while its references go, since they may be what keeps it alive.
  while (first_) {
    Ref<Object> const object(first_);
    object->drop_references();
    first_ = object->next_;
    if (first_) first_->previous_ = nullptr;
    object->previous_ = nullptr;
    object->next_ = nullptr;
    object->heap_ = nullptr;
  }
}

}  // namespace lapwing::dolphin
