#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

namespace lapwing::dolphin {

/// What a script value is. From `text` on the value is a reference to an `Object`.
enum class ValueKind : std::uint8_t {
  null,
  boolean,
  integer,
  real,
  text,
  list,
  map,
  entry,
  range,
  closure,
  vehicles,
  vehicle,
  position,
  displacement,
  area,
  task,
  error,
  outcome,
  type,
  pattern,
  cell,  ///< a captured variable; never seen by a script
};

class Heap;

/// What a reference value points to: reference counted, and known to its heap.
///
/// Counting is not atomic: a heap and its objects belong to one loop. Cycles live until the heap ends, which cuts them.
class Object {
 public:
  Object(Heap& heap, ValueKind kind);
  Object(Object const&) = delete;
  Object& operator=(Object const&) = delete;
  virtual ~Object() = default;

  [[nodiscard]] ValueKind kind() const { return kind_; }
  [[nodiscard]] Heap& heap() const { return *heap_; }
  void retain() { ++references_; }
  void release() {
    if (--references_ == 0) bury();
  }
  /// Lets go of every value it holds, so that cycles end with their heap.
  virtual void drop_references() {}

 protected:
  /// Tells the heap's estimate of memory in use what the object holds now; given back when it dies.
  void charge(std::size_t bytes);

 private:
  friend class Heap;
  void bury();

  Heap* heap_;
  Object* previous_ = nullptr;
  Object* next_ = nullptr;
  std::size_t charged_ = 0;
  std::uint32_t references_ = 0;
  ValueKind kind_;
};

/// Shared ownership of one object.
template <class T>
class Ref {
 public:
  Ref() = default;
  explicit Ref(T* object) : object_(object) { retain(); }
  Ref(Ref const& other) : object_(other.object_) { retain(); }
  Ref(Ref&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Ref& operator=(Ref other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Ref() {
    if (object_) object_->release();
  }

  [[nodiscard]] T* get() const { return object_; }
  T* operator->() const { return object_; }
  T& operator*() const { return *object_; }
  explicit operator bool() const { return object_ != nullptr; }

 private:
  void retain() {
    if (object_) object_->retain();
  }
  T* object_ = nullptr;
};

/// All objects of one program run, and an estimate of the memory they use.
class Heap {
 public:
  Heap() = default;
  Heap(Heap const&) = delete;
  Heap& operator=(Heap const&) = delete;
  /// Cuts every reference between objects. Objects still held from outside live on, empty.
  ~Heap();

  template <class T, class... Arguments>
  [[nodiscard]] Ref<T> make(Arguments&&... arguments) {
    return Ref<T>(new T(*this, std::forward<Arguments>(arguments)...));
  }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  friend class Object;
  void bury(Object* object);

  Object* first_ = nullptr;
  // Objects whose count fell to zero while another was being destroyed: a chain of a million lists must not recurse.
  Object* buried_ = nullptr;
  bool burying_ = false;
  std::size_t bytes_ = 0;
};

/// One value of the language: 16 bytes, cheap to copy.
class Value {
 public:
  Value() = default;
  static Value boolean(bool value) {
    Value result(ValueKind::boolean);
    result.as_.boolean = value;
    return result;
  }
  static Value integer(std::int64_t value) {
    Value result(ValueKind::integer);
    result.as_.integer = value;
    return result;
  }
  static Value real(double value) {
    Value result(ValueKind::real);
    result.as_.real = value;
    return result;
  }
  template <class T>
  Value(Ref<T> const& object) : Value(object.get()) {}
  explicit Value(Object* object) : kind_(object->kind()) {
    as_.object = object;
    object->retain();
  }

  Value(Value const& other) : kind_(other.kind_), as_(other.as_) {
    if (is_object()) as_.object->retain();
  }
  Value(Value&& other) noexcept : kind_(std::exchange(other.kind_, ValueKind::null)), as_(other.as_) {}
  Value& operator=(Value other) noexcept {
    std::swap(kind_, other.kind_);
    std::swap(as_, other.as_);
    return *this;
  }
  ~Value() {
    if (is_object()) as_.object->release();
  }

  [[nodiscard]] ValueKind kind() const { return kind_; }
  [[nodiscard]] bool is(ValueKind kind) const { return kind_ == kind; }
  [[nodiscard]] bool is_null() const { return kind_ == ValueKind::null; }
  [[nodiscard]] bool is_number() const { return kind_ == ValueKind::integer || kind_ == ValueKind::real; }
  [[nodiscard]] bool is_object() const { return kind_ >= ValueKind::text; }

  // Preconditions: the value is of that kind.
  [[nodiscard]] bool boolean() const { return as_.boolean; }
  [[nodiscard]] std::int64_t integer() const { return as_.integer; }
  [[nodiscard]] double real() const { return as_.real; }
  /// Either number kind as a double.
  [[nodiscard]] double number() const { return kind_ == ValueKind::real ? as_.real : static_cast<double>(as_.integer); }
  [[nodiscard]] Object& object() const { return *as_.object; }

  /// The object as a T; nothing when the value is of another kind.
  template <class T>
  [[nodiscard]] T* as() const {
    return kind_ == T::its_kind ? static_cast<T*>(as_.object) : nullptr;
  }

 private:
  explicit Value(ValueKind kind) : kind_(kind) {}
  union Payload {
    bool boolean;
    std::int64_t integer = 0;
    double real;
    Object* object;
  };
  ValueKind kind_ = ValueKind::null;
  Payload as_;
};

}  // namespace lapwing::dolphin
